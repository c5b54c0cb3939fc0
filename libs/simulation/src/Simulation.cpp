// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/simulation/Simulation.h"

#include "hoctomap/geometry/Errors.h"

namespace hoctomap {
namespace {

std::vector<std::uint16_t> labelsOf(const Scene& scene, const SolidImage& solids) {
  std::vector<std::uint16_t> labels;
  labels.reserve(solids.size());
  for (const std::int32_t solid : solids) {
    if (solid == kNoSolid)
      labels.push_back(0);
    else if (solid == kMixedSolids)
      labels.push_back(1);
    else
      labels.push_back(scene.pixelValue(SolidId{static_cast<std::uint32_t>(solid)}));
  }
  return labels;
}

SimulatedScan takeScan(const Simulation& simulation, const Scene& scene, SimulatedRangeSensor& sensor,
                       std::uint64_t number) {
  SimulatedScan scan;
  scan.scan = number;
  scan.stamp = simulation.start_stamp + static_cast<double>(number) * simulation.scan_period;
  scan.sensor = simulation.sensor_label;
  scan.view = simulation.views[number];
  scan.world_T_sensor = scan.view.world_T_sensor();
  scan.scene = scene;
  auto reading = sensor.sense(scene, scan.world_T_sensor, number);
  scan.image = std::move(reading.sensed.image);
  scan.solids = std::move(reading.sensed.solids);
  scan.rendering = std::move(reading.truth);
  scan.labels = labelsOf(scene, scan.solids);
  return scan;
}

}  // namespace

void simulateScene(const Simulation& simulation, int threads,
                   const std::function<void(const SimulatedScan&)>& sink) {
  if (simulation.views.empty()) throw ConfigError("a simulation needs at least one view");
  SimulatedRangeSensor sensor(simulation.sensor, simulation.seed, threads);
  Scene scene = simulation.scene;
  for (std::uint64_t k = 0; k < simulation.views.size(); ++k) {
    simulation.script.apply(scene, k);
    sink(takeScan(simulation, scene, sensor, k));
  }
}

}  // namespace hoctomap
