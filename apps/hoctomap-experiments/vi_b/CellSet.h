// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <unordered_set>

namespace hoctomap {

/// Which cells of a regular grid in the world hold something. The grid is that of an octree whose frame is
/// the world frame.
class CellSet {
 public:
  /// @param size edge of a cell, m
  explicit CellSet(double size) : size_(size) {}

  void insert(const Eigen::Vector3d& world_point);
  /// Whether an occupied cell is less than `reach` metres from the point along every axis.
  [[nodiscard]] bool anyNear(const Eigen::Vector3d& world_point, double reach) const;
  [[nodiscard]] double cellSize() const { return size_; }

 private:
  double size_;
  std::unordered_set<std::uint64_t> cells_;
};

}  // namespace hoctomap
