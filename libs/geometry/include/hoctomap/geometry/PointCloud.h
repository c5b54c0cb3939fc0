// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace hoctomap {

/// 3D endpoints, metres. The frame is named by the variable that holds them (`world_points`, `node_points`).
/// Single precision, as in OctoMap.
using PointCloud = std::vector<Eigen::Vector3f>;

/// Indices into the cloud of a measurement.
using PointIndices = std::vector<std::uint32_t>;

}  // namespace hoctomap
