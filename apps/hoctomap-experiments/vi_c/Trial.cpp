// SPDX-License-Identifier: BSD-3-Clause
#include "vi_c/Trial.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "MappingSetup.h"
#include "hoctomap/simulation/SimulatedRobot.h"
#include "vi_c/Baselines.h"
#include "vi_c/GainTruth.h"
#include "vi_c/JitteredScene.h"

namespace hoctomap {

namespace {

/// A robot whose measurements can be listened to.
class HeardRobot final : public MeasurementSource {
 public:
  HeardRobot(SimulatedRobot& robot, GainTruth& truth) : robot_(robot), truth_(truth) {}
  [[nodiscard]] std::optional<SourceItem> next() override {
    auto item = robot_.next();
    truth_.add(std::get<Measurement>(*item));
    ++scans_;
    return item;
  }
  [[nodiscard]] std::uint64_t scans() const { return scans_; }

 private:
  SimulatedRobot& robot_;
  GainTruth& truth_;
  std::uint64_t scans_ = 0;
};

ExplorationConfig configOf(const Settings& settings, ViewMethod method, std::uint64_t seed) {
  ExplorationConfig config = settings.explorationConfig();
  config.seed = seed * 1000;  // steps draw with the numbers after it
  if (method == ViewMethod::paper) {
    config.gain.measure = GainMeasure::entropy;
    config.gain.unknown_space = UnknownSpace::transparent;
    config.utility = UtilityForm::additive;
    config.alpha = 0.5;
  }
  return config;
}

Simulation jitteredSimulation(Simulation simulation, std::uint64_t seed) {
  simulation.scene = jittered(std::move(simulation.scene), seed);
  simulation.seed = seed;
  return simulation;
}

TrialStep inFigures(const ExplorationStep& step) {
  TrialStep figures{.kind = step.kind, .entropy = step.entropy, .unknown_in_boxes = step.unknown_in_boxes};
  for (const auto& candidate : step.candidates)
    figures.best_gain = std::max(figures.best_gain, candidate.gain);
  if (step.chosen) {
    figures.chosen_gain = step.candidates[*step.chosen].gain;
    figures.cost = step.candidates[*step.chosen].cost;
  }
  return figures;
}

class Run {
 public:
  Run(const TrialScene& scene, const Settings& settings, ViewMethod method, const TrialOptions& options)
      : settings_(settings),
        options_(options),
        simulation_(scene.simulation),
        coverage_(scene.coverage),
        config_(configOf(settings, method, scene.seed)),
        robot_(simulation_, RangeLimits{settings.sensor.min_range}),
        truth_(simulation_, config_),
        source_(robot_, truth_),
        mapper_(settings.mappingConfig(), settings.labels, makeStrategies(settings)) {
    trial_.scene = scene.name;
    trial_.method = method;
    trial_.seed = scene.seed;
    for (const SolidId id : simulation_.scene.ids()) {
      if (simulation_.scene.solid(id).label != SolidLabel::table) continue;
      tables_.push_back(id);
      trial_.tables.push_back(simulation_.scene.solid(id).name);
    }
  }

  Trial run() {
    if (trial_.method == ViewMethod::recommended || trial_.method == ViewMethod::paper)
      explore();
    else
      goAround();
    return std::move(trial_);
  }

 private:
  void explore() {
    Explorer explorer(config_, robot_, source_, mapper_);
    explorer.onStep([this](const ExplorationStep& step) { take(step); });
    const ExplorationResult result = explorer.run();
    trial_.ended_by_itself = result.tables.size() == tables_.size() &&
                             std::all_of(result.tables.begin(), result.tables.end(), [](const auto& entry) {
                               return entry.second == TableOutcome::explored;
                             });
  }

  void take(const ExplorationStep& step) {
    if (step.kind == StepKind::look_around) {
      if (step.scan && source_.scans() == static_cast<std::uint64_t>(config_.first_look))
        addView(std::nullopt, 0.0);
      return;
    }
    trial_.steps.push_back(inFigures(step));
    if (last_gain_) trial_.entropy_drops.emplace_back(*last_gain_, last_entropy_ - step.entropy);
    last_gain_.reset();
    if (step.kind == StepKind::view && options_.check_gains) {
      std::vector<GainCheck> checks = truth_.check(step);
      if (!checks.empty()) trial_.checks.push_back(std::move(checks));
    }
    if (step.kind == StepKind::view && step.scan) {
      last_gain_ = step.candidates[*step.chosen].gain;
      last_entropy_ = step.entropy;
    }
    travel_ += step.travel;
    if (step.scan) addView(tableOf(*step.table), 0.0);
    if (options_.check_gains) truth_.look(mapper_.hierarchy(), *step.table);
  }

  void goAround() {
    const Baseline baseline = trial_.method == ViewMethod::random     ? Baseline::random
                              : trial_.method == ViewMethod::circle_4 ? Baseline::circle_4
                                                                      : Baseline::circle_8;
    BaselineExplorer explorer(baseline, config_, options_.views, robot_, source_, mapper_);
    explorer.onLook([this] { addView(std::nullopt, 0.0); });
    explorer.onView(
        [this](const TableArea& area, double travel) { addView(nearestTable(area.center), travel); });
    explorer.run();
  }

  void addView(const std::optional<std::size_t>& table, double travel) {
    travel_ += travel;
    const auto held = coverage_.of(mapper_.hierarchy(), settings_.labels.at(labels::object).resolution);
    const RobotModel& robot = robot_.model();
    TrialView view{table,
                   travel_,
                   travel_ / robot.speed + static_cast<double>(source_.scans()) * robot.measuring_time,
                   held.all.value(),
                   {}};
    for (const SolidId id : tables_) view.table_coverage.push_back(coverage_.ofTable(held, id).value());
    trial_.views.push_back(std::move(view));
  }

  [[nodiscard]] std::optional<std::size_t> tableOf(NodeId node) const {
    if (!mapper_.hierarchy().contains(node)) return std::nullopt;
    const auto area = tableArea(mapper_.hierarchy(), node, config_.space);
    return area ? std::optional(nearestTable(area->center)) : std::nullopt;
  }

  [[nodiscard]] std::size_t nearestTable(const Eigen::Vector2d& center) const {
    const auto distance = [&](SolidId id) {
      const Pose pose = simulation_.scene.world_T_solid(id);
      return (Eigen::Vector2d(pose.x(), pose.y()) - center).norm();
    };
    const auto nearest = std::min_element(tables_.begin(), tables_.end(),
                                          [&](SolidId a, SolidId b) { return distance(a) < distance(b); });
    return static_cast<std::size_t>(nearest - tables_.begin());
  }

  const Settings& settings_;
  TrialOptions options_;
  const Simulation& simulation_;
  const SurfaceCoverage& coverage_;
  ExplorationConfig config_;
  SimulatedRobot robot_;
  GainTruth truth_;
  HeardRobot source_;
  HierarchyMapper mapper_;
  std::vector<SolidId> tables_;
  Trial trial_;
  double travel_ = 0.0;
  std::optional<double> last_gain_;
  double last_entropy_ = 0.0;
};

}  // namespace

std::string toString(ViewMethod method) {
  switch (method) {
    case ViewMethod::recommended:
      return "recommended";
    case ViewMethod::paper:
      return "paper";
    case ViewMethod::random:
      return "random";
    case ViewMethod::circle_4:
      return "circle of 4";
    case ViewMethod::circle_8:
      break;
  }
  return "circle of 8";
}

double Trial::tableCoverage(std::size_t table, int view) const {
  double coverage = 0.0;
  int taken = 0;
  for (const TrialView& v : views) {
    taken += v.table == table ? 1 : 0;
    if (taken > view) break;
    coverage = v.table_coverage[table];
  }
  return coverage;
}

std::optional<int> Trial::viewsUntil(std::size_t table, double share) const {
  int taken = 0;
  for (const TrialView& v : views) {
    taken += v.table == table ? 1 : 0;
    if (v.table_coverage[table] >= share) return taken;
  }
  return std::nullopt;
}

const TrialView* Trial::firstWith(double share) const {
  const auto found =
      std::find_if(views.begin(), views.end(), [share](const TrialView& v) { return v.coverage >= share; });
  return found == views.end() ? nullptr : &*found;
}

bool Trial::lastTripWasUseless() const {
  constexpr double kUseless = 0.002;
  for (std::size_t table = 0; table < tables.size(); ++table) {
    for (std::size_t i = views.size(); i-- > 1;) {
      if (views[i].table != table) continue;
      if (views[i].table_coverage[table] - views[i - 1].table_coverage[table] < kUseless) return true;
      break;
    }
  }
  return false;
}

TrialScene::TrialScene(std::string scene_name, const Simulation& from, std::uint64_t with_seed)
    : name(std::move(scene_name)),
      seed(with_seed),
      simulation(jitteredSimulation(from, with_seed)),
      coverage(simulation.scene, simulation.robot.value()) {}

Trial runTrial(const TrialScene& scene, const Settings& settings, ViewMethod method,
               const TrialOptions& options) {
  return Run(scene, settings, method, options).run();
}

}  // namespace hoctomap
