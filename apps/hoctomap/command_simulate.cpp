// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>
#include <memory>

#include "Command.h"
#include "Progress.h"
#include "hoctomap/config/SceneConfig.h"
#include "hoctomap/io/PipeLogWriter.h"
#include "hoctomap/simulation/Simulation.h"
#include "hoctomap/simulation/TruthWriter.h"

namespace hoctomap {

namespace {

struct SimulateOptions {
  std::string scene;
  std::string log;
  std::string truth;
  std::vector<std::string> overrides;
  int threads = 0;
  bool quiet = false;
};

/// Beside LOG.rawlog: LOG.truth
std::filesystem::path truthFolder(const SimulateOptions& options) {
  if (!options.truth.empty()) return options.truth;
  return std::filesystem::path(options.log).replace_extension(".truth");
}

int simulate(const SimulateOptions& options) {
  const Simulation simulation = loadScene(options.scene, options.overrides);
  RunLog log(0, options.quiet);
  Progress progress(log, simulation.views.size(), options.quiet);
  PipeLogWriter writer(options.log);
  TruthWriter truth(truthFolder(options), simulation.scene);
  std::uint64_t scans = 0;
  simulateScene(simulation, options.threads, [&](const SimulatedScan& scan) {
    writer.write(TruthPose{scan.stamp, "groundtruth", scan.view.world_T_base});
    writer.write(DepthScan{scan.scan, scan.stamp, scan.sensor, scan.world_T_sensor, scan.image});
    truth.write(scan);
    progress.show(++scans, std::nullopt);
  });
  truth.finish();
  writer.finish();
  progress.finish();
  std::cout << "log        " << options.log << " (" << scans << " scans)\n"
            << "truth      " << truthFolder(options).string() << std::endl;
  return 0;
}

}  // namespace

void addSimulateCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App* command = addCommand(app, "simulate", "Make a log of a simulated scene, with the truth beside it",
                                 {"hoctomap simulate -c configs/scenes/small_objects.ini -o small.rawlog"});
  command->add_option("-c,--config", options->scene, "scene")->type_name("SCENE.ini")->required();
  command->add_option("-o,--output", options->log, "the log")->type_name("LOG")->required();
  command
      ->add_option("--truth", options->truth,
                   "folder for the truth (default: LOG with .truth for its extension)")
      ->type_name("DIR");
  command->add_option("--threads", options->threads, "threads to use (default: all cores)")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  command->add_option("--set", options->overrides, "override a setting of the scene; may be repeated")
      ->type_name("section.key=value")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_flag("-q,--quiet", options->quiet, "say only warnings and errors");
  command->callback([options, &action] { action = [options] { return simulate(*options); }; });
}

}  // namespace hoctomap
