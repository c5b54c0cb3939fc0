// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hoctomap/geometry/PointCloud.h"

namespace hoctomap {

/// The connected components of the graph that joins two points at most `tolerance` metres apart
/// (Section IV-A), for organised and unorganised clouds alike.
///
/// Properties:
///  1. exact: the same components as a comparison of all pairs (in double precision);
///  2. every point is in exactly one cluster; indices ascend within a cluster;
///  3. clusters come by the lowest index they hold.
///
/// @throws std::invalid_argument if the tolerance is not positive, or a point is not finite or more than
///         5e8 tolerances from the origin.
[[nodiscard]] std::vector<PointIndices> euclideanClusters(std::span<const Eigen::Vector3f> points,
                                                          double tolerance);

}  // namespace hoctomap
