// SPDX-License-Identifier: BSD-3-Clause
#include "measuring/Scans.h"

#include <iostream>
#include <utility>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/PipeLogWriter.h"
#include "hoctomap/io/PipeSource.h"
#include "hoctomap/scenes/SceneConfig.h"
#include "hoctomap/simulation/Simulation.h"

namespace hoctomap {

std::vector<Measurement> readScans(const ScanChoice& choice) {
  LogReadOptions options;
  options.logs = {choice.log};
  options.start = choice.start;
  options.every = choice.every;
  options.max_scans = choice.max_scans;
  PipeSource source(options, RangeLimits{choice.min_range},
                    [](const std::string& text) { std::cerr << "warning: " << text << "\n"; });
  std::vector<Measurement> scans;
  while (auto item = source.next()) {
    if (auto* z = std::get_if<Measurement>(&*item)) scans.push_back(std::move(*z));
  }
  if (scans.empty()) throw InputError(choice.log.string() + ": no scan to measure with");
  return scans;
}

std::size_t pointsOf(const std::vector<Measurement>& scans) {
  std::size_t points = 0;
  for (const Measurement& z : scans) points += z.world_points.size();
  return points;
}

std::vector<std::string> quickScene() {
  return {"path.sweep.views=3", "camera.width=320", "camera.height=240", "camera.fx=270"};
}

std::size_t simulateLog(const std::filesystem::path& scene, const std::vector<std::string>& assignments,
                        const std::filesystem::path& log) {
  const Simulation simulation = loadScene(scene, assignments);
  PipeLogWriter writer(log);
  std::size_t scans = 0;
  simulateScene(simulation, 0, [&](const SimulatedScan& scan) {
    writer.write(TruthPose{scan.stamp, "groundtruth", scan.view.world_T_base});
    writer.write(DepthScan{scan.scan, scan.stamp, scan.sensor, scan.world_T_sensor, scan.image});
    ++scans;
  });
  writer.finish();
  return scans;
}

}  // namespace hoctomap
