// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "hoctomap/dataset/Dataset.h"
#include "hoctomap/geometry/Pose.h"

namespace hoctomap {

/// The largest horizontal structure of a data set: a floor, a table, a road.
struct LargestLevel {
  Pose level_T_world;   ///< turns the data set's world so that z is up; no translation
  double height = 0.0;  ///< z of the structure in the levelled world, metres
  double area = 0.0;    ///< of what was seen of it in the frames looked at, m^2, in cells of 5 cm
};

/// Looks at up to 12 frames spread over the data set. A direction is up if more surface faces it than any
/// other. Cameras are taken for held upright: up is within 60 degrees of the image's up and within 25 degrees
/// of the plane across its rows.
/// @throws InputError if there is no such structure, or as Dataset::frame()
[[nodiscard]] LargestLevel largestLevel(Dataset& dataset);

}  // namespace hoctomap
