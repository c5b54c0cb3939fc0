// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "hoctomap/geometry/PointCloud.h"

namespace hoctomap {

/// Unit normals of the surface that points were measured on: the direction in which the points of the 3 x 3 x
/// 3 cells around a point's own vary least. All points of a cell have one normal.
///
/// @param points any frame, any order.
/// @param cell edge of a cell, in metres: the surface is taken for flat over three of them.
/// @returns one vector a point, of either sign; zero where fewer than 6 points, or points on a line, say
/// nothing.
[[nodiscard]] PointCloud surfaceNormals(std::span<const Eigen::Vector3f> points, double cell);

}  // namespace hoctomap
