// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>

#include "Progress.h"
#include "SimulatorCommands.h"
#include "hoctomap/io/PipeLogWriter.h"
#include "hoctomap/scenes/SceneConfig.h"
#include "hoctomap/simulation/Simulation.h"
#include "hoctomap/simulation/TruthWriter.h"

namespace hoctomap {

namespace {

/// Beside LOG.rawlog: LOG.truth
std::filesystem::path truthFolder(const SimulateOptions& options) {
  if (!options.truth.empty()) return options.truth;
  return std::filesystem::path(options.log).replace_extension(".truth");
}

}  // namespace

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

}  // namespace hoctomap
