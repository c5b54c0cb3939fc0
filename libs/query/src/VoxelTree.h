// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>

#include "hoctomap/geometry/PointCloud.h"

namespace hoctomap {

/// Nearest-neighbour search in a set of voxel centres (nanoflann).
class VoxelTree {
 public:
  explicit VoxelTree(const PointCloud& points);
  ~VoxelTree();
  VoxelTree(VoxelTree&&) noexcept;
  VoxelTree& operator=(VoxelTree&&) noexcept;

  /// Whether there is a point within `radius` of `p`.
  [[nodiscard]] bool hasNear(const Eigen::Vector3f& p, double radius) const;

 private:
  struct Index;
  std::unique_ptr<Index> index_;
};

}  // namespace hoctomap
