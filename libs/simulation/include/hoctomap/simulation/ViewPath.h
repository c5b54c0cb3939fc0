// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "hoctomap/exploration/Viewpoint.h"

namespace hoctomap {

using View = Viewpoint;

/// The view of a camera at any pose; the base stands below it (z = 0) and heads where the camera does.
[[nodiscard]] View viewOfSensor(const Pose& world_T_sensor);

/// The view of a camera at `eye` whose optical axis meets `target`, with level horizon.
/// @throws ConfigError if the two coincide or lie above each other: then the horizon is undefined.
[[nodiscard]] View lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target);

/// The view of a robot at (x, y) heading `yaw`, with its camera at `height`, tilted down by `tilt` (radians).
[[nodiscard]] View viewOfBase(double x, double y, double yaw, double height, double tilt);

/// A sweep around a point.
struct ArcPath {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius = 1.3;        ///< metres from the centre to the camera
  double height = 1.3;        ///< metres, z of the camera
  double angle_begin = -0.8;  ///< radians about z, 0 = the camera stands on the +x side of the centre
  double angle_end = 0.8;
  Eigen::Vector3d target = Eigen::Vector3d::Zero();  ///< what the camera looks at
  int views = 20;
};

/// Views at equal angles, both ends included; for one view, the middle.
/// @throws ConfigError if radius or views are not positive, or a view looks straight up or down.
[[nodiscard]] std::vector<View> sweep(const ArcPath& path);

/// Views at equal angles all around, starting at `angle_begin`; `angle_end` is not used.
[[nodiscard]] std::vector<View> circle(const ArcPath& path);

}  // namespace hoctomap
