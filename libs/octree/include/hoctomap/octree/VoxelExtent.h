// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

namespace hoctomap {

/// Voxels of a map, counted at its resolution: a pruned leaf counts as all the voxels it covers.
struct VoxelCounts {
  std::uint64_t occupied = 0;
  std::uint64_t free = 0;
};

/// What a map knows and where, in the node's frame: whole voxels, no padding; empty boxes without any.
struct VoxelExtent {
  Eigen::AlignedBox3d known;     ///< of all voxels, occupied and free
  Eigen::AlignedBox3d occupied;  ///< of the occupied ones
  VoxelCounts voxels;
};

}  // namespace hoctomap
