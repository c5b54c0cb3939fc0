// SPDX-License-Identifier: BSD-3-Clause
#include <tbb/global_control.h>

#include <fstream>
#include <iostream>
#include <thread>

#include "ExplorationFiles.h"
#include "ExplorationPicture.h"
#include "InputIdentity.h"
#include "MappingSetup.h"
#include "MotionLedger.h"
#include "RecordedRobot.h"
#include "RunLog.h"
#include "RunSummary.h"
#include "SceneMaker.h"
#include "SimulatorCommands.h"
#include "StopSignal.h"
#include "TextTable.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/ChildProcess.h"
#include "hoctomap/io/CsvText.h"
#include "hoctomap/io/MapDescription.h"
#include "hoctomap/io/MapDirectory.h"
#include "hoctomap/io/Sha256.h"
#include "hoctomap/scenes/SceneConfig.h"

namespace hoctomap {

namespace {

/// Thrown out of the exploration when a signal asks to stop.
struct Stopped {};

/// `section.key=value` of a scene, not of the settings.
bool isOfScene(const std::string& assignment) {
  for (const char* section : {"simulation.", "camera.", "robot.", "solid.", "path.", "event."})
    if (assignment.starts_with(section)) return true;
  return false;
}

Simulation simulationOf(const ExploreOptions& options) {
  std::vector<std::string> assignments;
  if (options.seed) assignments.push_back("simulation.seed=" + std::to_string(*options.seed));
  std::copy_if(options.overrides.begin(), options.overrides.end(), std::back_inserter(assignments),
               isOfScene);
  return loadScene(options.scene, assignments);
}

/// Without a configuration of the user's, objects are mapped at the 5 mm of Section VI-C.
Settings settingsOf(const ExploreOptions& options) {
  std::vector<std::string> assignments;
  std::optional<std::filesystem::path> file;
  if (options.config)
    file = *options.config;
  else
    assignments.emplace_back("label.object.resolution=0.005");
  if (options.seed) assignments.push_back("exploration.seed=" + std::to_string(*options.seed));
  std::remove_copy_if(options.overrides.begin(), options.overrides.end(), std::back_inserter(assignments),
                      isOfScene);
  Settings settings = loadSettings(file, assignments);
  if (settings.monolithic) throw ConfigError("explore needs a hierarchy ([mapping] monolithic)");
  return settings;
}

/// As a `build` of the log alone would remember it.
std::string inputOf(const std::filesystem::path& log) {
  std::ifstream in(log, std::ios::binary);
  LogReadOptions read;
  read.logs = {log};
  return InputIdentity(read, {sha256Hex(std::string{std::istreambuf_iterator<char>(in), {}})}).text();
}

/// One exploration: the robot in the scene, the map that it makes, and all that is written of it.
class Exploration {
 public:
  Exploration(const ExploreOptions& options, const Simulation& simulation, const Settings& settings,
              MapDirectory& directory, RunLog& log)
      : settings_(settings),
        limits_{settings.sensor.min_range},
        directory_(directory),
        log_(log),
        log_file_(directory.path() / "exploration.rawlog"),
        robot_(simulation, limits_, options.threads),
        writer_(log_file_),
        source_(robot_, writer_, limits_),
        coverage_(simulation.scene, *simulation.robot),
        mapper_(settings.mappingConfig(), settings.labels, makeStrategies(settings)),
        table_(robot_.model()) {
    std::filesystem::remove_all(traversabilityFolder());
    std::filesystem::create_directories(traversabilityFolder());
  }

  /// @return the signal that stopped it, or 0
  int run() {
    Explorer explorer(settings_.explorationConfig(), robot_, source_, mapper_);
    explorer.onMeasurement([this](const Measurement& z, const UpdateReport& report) { take(z, report); });
    explorer.onStep([this](const ExplorationStep& step) { take(step); });
    try {
      result_ = explorer.run();
    } catch (const Stopped&) {
      log_.warn("stopped by a signal; what was explored is committed");
    }
    finish();
    return StopSignal::requested();
  }

  /// What came of it, for people.
  [[nodiscard]] std::string text() const {
    std::string text = summary_.text();
    for (const auto& [node, outcome] : result_.tables)
      text += "table " + std::to_string(node.value) + "    " + toString(outcome) + "\n";
    text += "robot      " + std::to_string(result_.measurements) + " scans, " + fixedText(result_.travel, 1) +
            " m, " + fixedText(result_.seconds, 0) + " s\n";
    const auto held = coverage_.of(mapper_.hierarchy(), voxelOfObjects());
    text += "coverage   " + fixedText(100.0 * held.all.value(), 1) +
            " % of the surface of objects that the robot could see\n";
    return text;
  }

 private:
  [[nodiscard]] std::filesystem::path traversabilityFolder() const {
    return directory_.path() / "traversability";
  }
  [[nodiscard]] double voxelOfObjects() const { return settings_.labels.at(labels::object).resolution; }

  void take(const Measurement& z, const UpdateReport& report) {
    last_scan_ = z.scan;
    last_stamp_ = z.stamp;
    (void)motions_.takeDue(z.scan, z.stamp);
    motions_.finishScan();
    summary_.addUsed(z);
    summary_.addReport(report);
    directory_.append(report);
    directory_.append(scanRow(z));
    directory_.append(TimingRow{z.scan, z.world_points.size(), 0.0, report.seconds, 0.0});
  }

  void take(const ExplorationStep& step) {
    const double coverage = coverage_.of(mapper_.hierarchy(), voxelOfObjects()).all.value();
    table_.add(step, coverage);
    picture_.add(step);
    if (step.traversability != nullptr) {
      std::string number = std::to_string(step.step);
      number.insert(0, 6 - std::min<std::size_t>(6, number.size()), '0');
      writeTraversability(*step.traversability, traversabilityFolder() / number);
    }
    log_.info("step " + std::to_string(step.step) + ": " + toString(step.kind) +
              (step.table ? ", table " + std::to_string(step.table->value) : "") + ", coverage " +
              fixedText(100.0 * coverage, 1) + " %");
    if (StopSignal::requested() != 0) throw Stopped{};
  }

  void finish() {
    if (last_scan_) {
      const UpdateReport report = mapper_.finish(*last_scan_, last_stamp_);
      summary_.addReport(report);
      directory_.appendEnd(report);
    }
    writer_.finish();
    const auto& path = directory_.path();
    const auto held = coverage_.of(mapper_.hierarchy(), voxelOfObjects());
    writeTextFile(path / "exploration.csv", table_.text());
    writeTextFile(path / "coverage.csv", coverageCsv(robot_.scene(), coverage_, held));
    directory_.commit({mapper_.hierarchy(), mapper_.removed(), last_scan_ ? *last_scan_ + 1 : 0,
                       inputOf(log_file_), false, last_stamp_, &mapper_.seams(), mapper_.sensor(),
                       motions_.taken(), summary_.mappedInAll()});
    directory_.writeScene(makeScene);
    picture_.draw(mapper_.hierarchy(), path / "exploration.png");
    if (runHelper({"render", path.string(), "-o", (path / "model.png").string(), "--hide",
                   labels::background.name}) != 0)
      throw FileError((path / "model.png").string() + ": could not be drawn");
  }

  const Settings& settings_;
  RangeLimits limits_;
  MapDirectory& directory_;
  RunLog& log_;
  std::filesystem::path log_file_;
  SimulatedRobot robot_;
  PipeLogWriter writer_;
  RecordedRobot source_;
  SurfaceCoverage coverage_;
  HierarchyMapper mapper_;
  ExplorationTable table_;
  ExplorationPicture picture_;
  RunSummary summary_;
  MotionLedger motions_{{}, std::nullopt};  // nobody tells of any
  ExplorationResult result_;
  std::optional<std::uint64_t> last_scan_;
  double last_stamp_ = 0.0;
};

}  // namespace

int explore(const ExploreOptions& options) {
  const Simulation simulation = simulationOf(options);
  if (!simulation.robot) throw ConfigError(options.scene + ": needs a section [robot]");
  const Settings settings = settingsOf(options);
  RunLog log(options.verbose, options.quiet);
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    options.threads > 0 ? static_cast<std::size_t>(options.threads) : cores);
  const StopSignal stop_signal(StopSignal::LongWork::waited_for);
  const MapOpenMode mode = options.overwrite ? MapOpenMode::overwrite : MapOpenMode::create;
  MapDirectory directory(options.output, {mode, toIni(settings), "hoctomap " HOCTOMAP_VERSION, {}});
  log.writeTo(directory.logFile());

  Exploration exploration(options, simulation, settings, directory, log);
  const int signal = exploration.run();
  std::cout << describeMap(readManifest(directory.path())) << "\n"
            << exploration.text() << "map        " << options.output << std::endl;
  return signal == 0 ? 0 : 128 + signal;
}

}  // namespace hoctomap
