// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <set>
#include <string>

#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {

/// Where a picture is taken from: on a sphere around a point.
struct RenderCamera {
  Eigen::Vector3d target = Eigen::Vector3d::Zero();  ///< world, metres
  double distance = 1.0;                             ///< metres
  double azimuth = 0.0;                              ///< degrees, of the camera seen from the target
  double elevation = 0.0;                            ///< degrees
  double field_of_view = 30.0;                       ///< degrees, of the picture's height
};

struct SensorView;

/// The camera of a sensor. @param hierarchy what it looks at, for the distance
[[nodiscard]] RenderCamera cameraOf(const SensorView& sensor, const MapHierarchy& hierarchy, double aspect);

/// A camera that frames tables and objects (the background if there are none).
/// @param aspect width over height of the picture. @param hidden labels of nodes that are left out.
/// @throws ConfigError if there is no such view.
[[nodiscard]] RenderCamera cameraFor(const MapHierarchy& hierarchy, const std::string& view, double aspect,
                                     const std::set<Label>& hidden = {});

}  // namespace hoctomap
