// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "hoctomap/exploration/Viewpoint.h"
#include "hoctomap/geometry/Measurement.h"

namespace hoctomap {

/// What exploration has to know of a robot: a round platform with a range camera on a lift that can look up
/// and down.
struct RobotModel {
  double radius = 0.35;         ///< m, of the base
  double height = 1.5;          ///< m: obstacles above pass over it
  double speed = 0.5;           ///< m/s
  double measuring_time = 3.0;  ///< s, to take one measurement

  PinholeCamera camera{640, 480, 540.0, 540.0, 319.5, 239.5};
  double min_range = 0.5;          ///< m, along the optical axis: nearer gives no return
  double max_range = 4.0;          ///< m, along the optical axis: what can be measured well
  double min_sensor_height = 1.2;  ///< m above the floor
  double max_sensor_height = 1.2;  ///< m
  double min_tilt = 0.0;           ///< radians, downwards
  double max_tilt = 0.8;           ///< radians
};

/// The port to a robot. A real robot implements this and `MeasurementSource`; exploration knows no other.
class Robot {
 public:
  virtual ~Robot() = default;

  [[nodiscard]] virtual const RobotModel& model() const = 0;

  /// Where the robot believes its base to be.
  [[nodiscard]] virtual Pose world_T_base() const = 0;

  /// Drives along the path (world x, y; from where it stands to the goal) and takes the posture of the goal.
  /// @return false if it could not: then it is where `world_T_base` says.
  virtual bool moveTo(const Viewpoint& goal, std::span<const Eigen::Vector2d> path) = 0;
};

}  // namespace hoctomap
