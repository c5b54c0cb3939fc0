// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "hoctomap/exploration/Robot.h"

namespace hoctomap {

/// A robot of a simulation, and how well it does.
struct SimulatedRobotConfig {
  RobotModel model;           ///< camera and nearest range are those of the simulated sensor
  Pose world_T_start;         ///< of the base, on the floor
  double body_margin = 0.05;  ///< m, by which the true body is smaller than the radius that is planned with
  double ground_clearance = 0.1;  ///< m: lower things are driven over
  double position_error = 0.0;    ///< m, sigma in x and y of where it is after a drive
  double heading_error = 0.0;     ///< radians, sigma of its heading
  double move_failure = 0.0;      ///< probability that a drive ends somewhere on the way
};

/// @throws ConfigError if a size, speed or range is not positive, limits are out of order, or the probability
///         is outside [0, 1].
void check(const SimulatedRobotConfig& config);

}  // namespace hoctomap
