// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/exploration/Explorer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/geometry/ForEachIndex.h"

namespace hoctomap {

namespace {

double lengthOf(const std::vector<Eigen::Vector2d>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

Eigen::Vector2d placeOf(const Pose& world_T_base) {
  return {world_T_base.x(), world_T_base.y()};
}

/// The first place of a path behind the one that is nearest to where the robot is.
std::optional<Eigen::Vector2d> nextOn(const std::vector<Eigen::Vector2d>& path, const Eigen::Vector2d& here) {
  const auto nearest = std::min_element(path.begin(), path.end(), [&](const auto& a, const auto& b) {
    return (a - here).squaredNorm() < (b - here).squaredNorm();
  });
  if (nearest == path.end() || nearest + 1 == path.end()) return std::nullopt;
  return *(nearest + 1);
}

}  // namespace

std::string toString(TableOutcome outcome) {
  switch (outcome) {
    case TableOutcome::explored:
      return "explored";
    case TableOutcome::unreachable:
      return "unreachable";
    case TableOutcome::out_of_views:
      break;
  }
  return "out_of_views";
}

/// What a viewpoint was chosen for.
struct Explorer::Promise {
  Eigen::Vector2d place;
  double gain;
  std::size_t unknown;  ///< cells before the view
};

/// What the exploration knows of a table.
struct Explorer::TableState {
  TableArea area;
  std::optional<ClearedSpace> cleared;
  std::size_t cleared_scans = 0;  ///< that it has
  int views = 0;
  int failed_moves = 0;                 ///< in a row
  std::optional<Promise> promise;       ///< of the last view of its objects
  std::vector<Eigen::Vector2d> barren;  ///< places that did not keep theirs
  std::optional<double> first_everything_gain;
  std::optional<double> first_box_gain;
  std::optional<TableOutcome> outcome;
};

/// What is kept of a measurement.
struct Explorer::Scan {
  Eigen::Vector3f origin;
  PointCloud world_points;
};

Explorer::Explorer(const ExplorationConfig& config, Robot& robot, MeasurementSource& sensor,
                   HierarchyMapper& mapper)
    : config_(config),
      robot_(robot),
      sensor_(sensor),
      mapper_(mapper),
      sampler_(config.viewpoints, robot.model()),
      gain_(config.gain, robot.model()) {
  if (!(config.alpha >= 0.0 && config.alpha <= 1.0))
    throw ConfigError("[exploration] alpha must lie in [0, 1]");
  if (!(config.tau >= 0.0)) throw ConfigError("[exploration] tau must not be negative");
  if (config.first_look < 1 || config.max_views < 1)
    throw ConfigError("[exploration] views must be positive");
}

Explorer::~Explorer() = default;

ExplorationResult Explorer::run() {
  lookAround();
  while (const auto table = findNearestUnexploredTable()) exploreStep(*table);
  for (const auto& [id, state] : tables_) {
    if (state.outcome && mapper_.hierarchy().contains(id)) result_.tables.emplace(id, *state.outcome);
  }
  return result_;
}

/// "A measurement of the robot's surroundings from its current location": all around, since cameras see a
/// part.
void Explorer::lookAround() {
  const Pose start = robot_.world_T_base();
  const RobotModel& robot = robot_.model();
  constexpr double kTilt = 0.44;  // radians: floor and tables, and the walls as high as the camera
  for (int i = 0; i < config_.first_look; ++i) {
    const double yaw = start.yaw() + 2.0 * std::numbers::pi * i / config_.first_look;
    const Viewpoint v{
        Pose(start.x(), start.y(), 0.0, yaw, 0.0, 0.0),
        Pose(0.0, 0.0, robot.max_sensor_height, 0.0, std::clamp(kTilt, robot.min_tilt, robot.max_tilt), 0.0)};
    ExplorationStep step;
    step.candidates.push_back({.viewpoint = v, .cost = robot.measuring_time});
    step.chosen = 0;
    const std::vector<Eigen::Vector2d> here{placeOf(start)};
    if (robot_.moveTo(v, here)) {
      measure(step);
    } else {
      step.kind = StepKind::move_failed;
    }
    report(step);
  }
}

/// The table of the map that is next to the robot and has no outcome yet.
std::optional<TableArea> Explorer::findNearestUnexploredTable() {
  const Eigen::Vector2d here = placeOf(robot_.world_T_base());
  std::optional<TableArea> nearest;
  double best = std::numeric_limits<double>::infinity();
  for (TableArea& area : tableAreas(mapper_.hierarchy(), config_.space)) {
    if (const auto known = tables_.find(area.node); known != tables_.end() && known->second.outcome) continue;
    // A table that has been explored may have become a part of another node since.
    const bool done = std::any_of(tables_.begin(), tables_.end(), [&](const auto& entry) {
      const auto& [id, state] = entry;
      constexpr double kSameFace = 0.05;  // m
      return state.outcome && !mapper_.hierarchy().contains(id) &&
             state.area.distanceTo(area.center) == 0.0 && std::fabs(state.area.top - area.top) < kSameFace;
    });
    const double distance = area.distanceTo(here);
    if (done || distance >= best) continue;
    best = distance;
    nearest = std::move(area);
  }
  return nearest;
}

/// One turn of the loop: V, I and cost of its members, v*, and the measurement there.
void Explorer::exploreStep(const TableArea& area) {
  TableState& state = tables_[area.node];
  state.area = area;
  const RobotModel& robot = robot_.model();
  const Eigen::Vector2d here = placeOf(robot_.world_T_base());
  TraversabilityMap traversability(mapper_.hierarchy(), config_.traversability, robot.radius, robot.height,
                                   here);
  for (const FailedPlace& failed : failed_) traversability.block(failed.place, failed.radius);
  const TravelCost travel(traversability, here, robot.speed, robot.measuring_time);
  const KnowledgeGrid knowledge(mapper_.hierarchy(), area, clearedOf(state), config_.cell, robot.max_range);

  ExplorationStep step;
  step.table = area.node;
  step.traversability = &traversability;
  step.entropy = knowledge.entropy();
  step.unknown_in_boxes = knowledge.count(Knowledge::unknown_in_box);
  if (state.views >= config_.max_views) return end(state, TableOutcome::out_of_views, step);

  noteBrokenPromise(state, step.unknown_in_boxes);
  const Wanted wanted = wantedOf(state);
  step.kind = wanted == Wanted::boxes ? StepKind::view : StepKind::first_view;
  // What is left may be seen from few places: a table is not given up for one set V that has none of them.
  constexpr std::uint64_t kDraws = 3;
  bool worth_it = false;
  for (std::uint64_t draw = 0; draw < kDraws && !worth_it; ++draw) {
    const std::vector<Viewpoint> candidates = candidatesOf(area, travel, draw);
    if (candidates.empty()) return end(state, TableOutcome::unreachable, step);
    evaluate(step, candidates, knowledge, travel, wanted);
    if (wanted == Wanted::boxes) passOver(state.barren, step);
    std::optional<double>& first_gain =
        wanted == Wanted::boxes ? state.first_box_gain : state.first_everything_gain;
    if (!first_gain) first_gain = step.mostGain();
    step.choose(config_.tau * *first_gain);
    worth_it = step.chosen.has_value();
  }
  if (!worth_it) {
    // Never seen at all: not from where the robot can get to.
    return end(state, state.views == 0 ? TableOutcome::unreachable : TableOutcome::explored, step);
  }
  if (wanted == Wanted::boxes) {
    const auto& chosen = step.candidates[*step.chosen];
    state.promise = Promise{placeOf(chosen.viewpoint.world_T_base), chosen.gain, step.unknown_in_boxes};
  }
  goAndMeasure(state, travel, step);
  report(step);
}

/// Where less than a tenth of what a view promised became known, rays of the gain meet what beams do not.
void Explorer::noteBrokenPromise(TableState& state, std::size_t unknown) {
  constexpr double kKept = 0.1;
  if (state.promise && state.failed_moves == 0 &&
      static_cast<double>(state.promise->unknown) - static_cast<double>(unknown) <
          kKept * state.promise->gain) {
    state.barren.push_back(state.promise->place);
  }
  state.promise.reset();
}

/// A view from beside a barren place promises the same, and would not keep it either.
void Explorer::passOver(const std::vector<Eigen::Vector2d>& barren, ExplorationStep& step) {
  constexpr double kBeside = 0.5;  // m
  for (auto& candidate : step.candidates) {
    const Eigen::Vector2d place = placeOf(candidate.viewpoint.world_T_base);
    const bool is_beside = std::any_of(barren.begin(), barren.end(),
                                       [&](const auto& b) { return (place - b).norm() < kBeside; });
    if (is_beside) candidate.gain = candidate.utility = 0.0;
  }
}

/// The first view of a table looks for its objects anywhere over it; afterwards what is unknown in their
/// boxes counts: from above, top and front fix most of a box, so that its unknown part is the sides that
/// nobody has seen.
Wanted Explorer::wantedOf(const TableState& state) {
  return state.views == 0 ? Wanted::everything : Wanted::boxes;
}

std::vector<Viewpoint> Explorer::candidatesOf(const TableArea& area, const TravelCost& travel,
                                              std::uint64_t draw) const {
  constexpr std::uint64_t kFarApart = 1ULL << 32U;  // of the seeds of other steps
  std::vector<Viewpoint> candidates = sampler_.sample(area, travel, config_.seed + steps_ + draw * kFarApart);
  if (!candidates.empty()) return candidates;
  // Nothing near it: the nearest place that the camera reaches the table from.
  const TraversabilityMap& map = travel.map();
  double best = robot_.model().max_range;
  std::optional<Eigen::Vector2d> nearest;
  for (std::size_t i = 0; i < map.cells(); ++i) {
    const Eigen::Vector2d place = map.center(map.cell(i));
    if (!travel.length(place)) continue;
    const double distance = area.distanceTo(place);
    if (distance >= best) continue;
    best = distance;
    nearest = place;
  }
  if (nearest) candidates.push_back(sampler_.facing(area, *nearest, robot_.model().max_sensor_height));
  return candidates;
}

void Explorer::evaluate(ExplorationStep& step, const std::vector<Viewpoint>& candidates,
                        const KnowledgeGrid& knowledge, const TravelCost& travel, Wanted wanted) const {
  step.candidates.resize(candidates.size());
  forEachIndex(candidates.size(), [&](std::size_t i) {
    ExplorationStep::Candidate& candidate = step.candidates[i];
    candidate.viewpoint = candidates[i];
    candidate.gain = gain_(knowledge, candidates[i], wanted);
    candidate.cost = *travel.seconds(placeOf(candidates[i].world_T_base));  // candidates can be reached
    candidate.utility = utilityOf(candidate.gain, candidate.cost);
  });
}

double Explorer::utilityOf(double gain, double cost) const {
  const double alpha = config_.alpha;
  if (config_.utility == UtilityForm::additive) return alpha * gain - (1.0 - alpha) * cost;
  return alpha < 1.0 ? std::pow(gain, alpha / (1.0 - alpha)) / cost : gain;
}

void Explorer::goAndMeasure(TableState& state, const TravelCost& travel, ExplorationStep& step) {
  const Viewpoint& goal = step.candidates[*step.chosen].viewpoint;
  step.path = travel.path(placeOf(goal.world_T_base));
  const Eigen::Vector2d before = placeOf(robot_.world_T_base());
  if (robot_.moveTo(goal, step.path)) {
    step.travel = lengthOf(step.path);
    state.failed_moves = 0;
    ++state.views;
    measure(step);
  } else {
    step.kind = StepKind::move_failed;
    const Eigen::Vector2d stopped = placeOf(robot_.world_T_base());
    step.travel = (stopped - before).norm();
    failed_.push_back({placeOf(goal.world_T_base), robot_.model().radius});
    // Nor does the way there lead on from where it stopped.
    if (const auto ahead = nextOn(step.path, stopped))
      failed_.push_back({*ahead, config_.traversability.cell});
    constexpr int kPatience = 5;
    if (++state.failed_moves >= kPatience) state.outcome = TableOutcome::unreachable;
  }
  result_.travel += step.travel;
  result_.seconds += step.travel / robot_.model().speed;
}

void Explorer::measure(ExplorationStep& step) {
  auto item = sensor_.next();
  if (!item || !std::holds_alternative<Measurement>(*item)) {
    throw InputError("the robot's sensor gave no measurement");
  }
  const Measurement& z = std::get<Measurement>(*item);
  const UpdateReport update = mapper_.integrate(z);
  step.scan = z.scan;
  ++result_.measurements;
  result_.seconds += robot_.model().measuring_time;
  scans_.push_back({z.origin().cast<float>(), z.world_points});
  if (on_measurement_) on_measurement_(z, update);
}

void Explorer::end(TableState& state, TableOutcome outcome, ExplorationStep& step) {
  state.outcome = outcome;
  step.kind = outcome == TableOutcome::explored      ? StepKind::explored
              : outcome == TableOutcome::unreachable ? StepKind::unreachable
                                                     : StepKind::out_of_views;
  report(step);
}

void Explorer::report(ExplorationStep& step) {
  step.step = steps_++;
  if (on_step_) on_step_(step);
}

/// The space over a table with all scans so far; made anew when the table turns out to be larger.
const ClearedSpace& Explorer::clearedOf(TableState& state) {
  if (!state.cleared || !state.cleared->space().contains(state.area.space)) {
    state.cleared.emplace(state.area.space, config_.cleared_resolution, config_.noise);
    state.cleared_scans = 0;
  }
  for (; state.cleared_scans < scans_.size(); ++state.cleared_scans) {
    const Scan& scan = scans_[state.cleared_scans];
    state.cleared->add(scan.origin, scan.world_points);
  }
  return *state.cleared;
}

}  // namespace hoctomap
