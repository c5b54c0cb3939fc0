// SPDX-License-Identifier: BSD-3-Clause
#include <tbb/global_control.h>

#include <functional>
#include <iostream>
#include <memory>

#include "BuildEstimate.h"
#include "Command.h"
#include "InputIdentity.h"
#include "LogOptions.h"
#include "MapRun.h"
#include "MappingSetup.h"
#include "MotionLedger.h"
#include "SceneMaker.h"
#include "StopSignal.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/MapDescription.h"
#include "hoctomap/io/MapReader.h"

namespace hoctomap {

namespace {

struct BuildOptions {
  LogOptions log;
  bool resume = false;
  bool overwrite = false;
  std::uint64_t snapshot_every = 0;
  std::string events;
  bool monolithic = false;
  bool estimate = false;
  bool json = false;
};

Settings settingsOf(const BuildOptions& options) {
  LogOptions log = options.log;
  if (options.monolithic) log.overrides.emplace_back("mapping.monolithic=true");
  return log.settings();
}

int estimate(const BuildOptions& options) {
  RunLog log(options.log.verbose, options.log.quiet);
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, options.log.threadCount());
  const Settings settings = settingsOf(options);
  const BuildEstimate result = estimateBuild(settings, options.log.readOptions(settings),
                                             [&log](const std::string& text) { log.warn(text); });
  std::cout << (options.json ? result.json() : result.text()) << std::flush;
  return 0;
}

/// What has been mapped already, if a run is continued.
std::optional<Manifest> committedMap(const BuildOptions& options) {
  const std::filesystem::path directory(options.log.output);
  if (!options.resume || !std::filesystem::exists(directory / "hierarchy.yaml")) return std::nullopt;
  return readManifest(directory);
}

HierarchyMapper makeMapper(const Settings& settings, const std::optional<Manifest>& committed,
                           const std::filesystem::path& directory) {
  if (!committed) return {settings.mappingConfig(), settings.labels, makeStrategies(settings)};
  MapReadOptions options;
  options.to_go_on = true;
  StoredMap stored = readMap(directory, options);
  return {settings.mappingConfig(),    settings.labels,         makeStrategies(settings),
          std::move(stored.hierarchy), std::move(stored.seams), stored.manifest.sensor};
}

int build(const BuildOptions& options) {
  const Settings settings = settingsOf(options);
  RunLog log(options.log.verbose, options.log.quiet);
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, options.log.threadCount());

  // The logs are gone through once before anything is written.
  const auto committed = committedMap(options);
  LogReadOptions read = options.log.readOptions(settings);
  if (committed) read.resume_at = committed->scans;
  MotionLedger motions(options.events.empty() ? std::vector<ToldMotion>() : readMotionFile(options.events),
                       committed ? committed->motions : std::nullopt);
  PipeSource source(read, RangeLimits{settings.sensor.min_range},
                    [&log](const std::string& text) { log.warn(text); });
  const InputIdentity input(read, source.header().log_sha256);
  if (committed) {
    if (const auto why = input.contradiction(committed->input)) {
      throw InputError(options.log.output + ": cannot be continued: " + *why);
    }
  }

  // A signal before this changes nothing, so it may end the program.
  const StopSignal stop_signal(StopSignal::LongWork::given_up);
  const MapOpenMode mode = options.resume      ? MapOpenMode::resume
                           : options.overwrite ? MapOpenMode::overwrite
                                               : MapOpenMode::create;
  MapDirectory directory(options.log.output, {mode, toIni(settings), "hoctomap " HOCTOMAP_VERSION, {}});
  if (committed && (!directory.committed() || directory.committed()->scans != committed->scans)) {
    throw FileError(options.log.output + ": another program has changed the map just now");
  }
  log.writeTo(directory.logFile());
  log.info("poses: " + source.header().pose_source);
  if (committed) log.info("continuing at scan " + std::to_string(committed->scans));

  HierarchyMapper mapper = makeMapper(settings, committed, directory.path());
  const Manifest before = committed.value_or(Manifest());
  MapRun run(settings, mapper, directory, log,
             {input.text(), read.resume_at, before.last_stamp, before.mapped_scans, before.skipped_scans,
              options.snapshot_every},
             motions);
  SceneMaker make_scene;
  {
    Progress progress(log, source.totalScans(), options.log.quiet);
    run.run(source, progress);
  }
  // A stopped run ends at once; the scene is no part of the map's state.
  if (StopSignal::requested() == 0) directory.writeScene(std::ref(make_scene));

  const Manifest after = readManifest(directory.path());
  std::cout << describeMap(after) << "\n"
            << labelTable(after) << "\n"
            << run.summary().text() << "map        " << options.log.output << std::endl;
  if (const int signal = StopSignal::requested()) {
    log.warn("stopped by signal " + std::to_string(signal) +
             "; what was mapped is committed (--continue goes on)");
    return 128 + signal;
  }
  if (run.summary().skippedMoreThan(settings.limits.max_skipped_share)) {
    log.warn("too many scans were skipped ([limits] max_skipped_share)");
    return 3;
  }
  return 0;
}

}  // namespace

void addBuildCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<BuildOptions>();
  CLI::App* command = addCommand(app, "build", "Build a hierarchy of octree maps from logs",
                                 {"hoctomap build -i log.rawlog -o map",
                                  "hoctomap build -c configs/paper.ini -i a.rawlog -i b.rawlog -o map",
                                  "hoctomap build -i log.rawlog -o map --set label.object.resolution=0.004"});
  options->log.addTo(*command);
  auto* resume =
      command->add_flag("--continue", options->resume,
                        "go on with the map in DIR; further logs may follow those it was built from");
  command->add_flag("--overwrite", options->overwrite, "replace the map in DIR")->excludes(resume);
  command
      ->add_option("--snapshot-every", options->snapshot_every,
                   "keep the state after every N scans of the log")
      ->type_name("N");
  command
      ->add_option("--events", options->events,
                   "movements of nodes: CSV with scan|time, node|px,py,pz, x,y,z,yaw,pitch,roll")
      ->type_name("FILE");
  command->add_flag("--monolithic", options->monolithic, "one single map, as stock OctoMap would build it");
  auto* output = command->get_option("--output")->required(false);
  auto* estimate_only = command->add_flag(
      "--estimate", options->estimate, "say what a build would take, by a few of its scans; writes nothing");
  command->add_flag("--json", options->json, "the estimate for programs")->needs(estimate_only);
  command->callback([options, output, &action] {
    if (!options->estimate && output->empty()) throw CLI::RequiredError(output->get_name());
    action = [options] { return options->estimate ? estimate(*options) : build(*options); };
  });
}

}  // namespace hoctomap
