// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hoctomap/simulation/Scene.h"
#include "hoctomap/simulation/SceneScript.h"
#include "hoctomap/simulation/SimulatedRangeSensor.h"
#include "hoctomap/simulation/SimulatedRobotConfig.h"
#include "hoctomap/simulation/ViewPath.h"

namespace hoctomap {

/// All that a simulated log is made of. The log has one scan a view, unless a robot chooses the views itself.
struct Simulation {
  Scene scene;  ///< before the first scan
  SceneScript script;
  RangeSensorModel sensor;
  std::string sensor_label = "RGBD";
  std::vector<View> views;
  std::uint64_t seed = 1;
  double start_stamp = 1.3e9;  ///< seconds since the epoch, of scan 0
  double scan_period = 0.5;    ///< seconds
  std::optional<SimulatedRobotConfig> robot;
};

/// One scan of the log, with its truth.
struct SimulatedScan {
  std::uint64_t scan = 0;
  double stamp = 0.0;  ///< seconds since the epoch
  std::string sensor;
  DepthImage image;     ///< as measured, with noise and faults
  View view;            ///< robot base on the floor, and the sensor on it
  Pose world_T_sensor;  ///< exact

  Scene scene;          ///< as it was when the scan was taken
  Rendering rendering;  ///< what a faultless camera would have seen
  SolidImage solids;    ///< solid that each return of `image` comes from
  /// As `segment` writes it: 0 no return, 1 background or between two solids, 10+i table i, 100+j object j.
  std::vector<std::uint16_t> labels;
};

/// Takes every scan in turn. The scans are the same for any number of threads.
/// @param threads 0 = as many as the machine has
/// @throws ConfigError if views are missing, or the sensor or the script make no sense.
void simulateScene(const Simulation& simulation, int threads,
                   const std::function<void(const SimulatedScan&)>& sink);

}  // namespace hoctomap
