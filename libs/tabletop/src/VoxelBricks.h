// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>

#include "VoxelIndex.h"

namespace hoctomap {

/// Numbers the voxels that hold something, brick by brick: a brick is 4^3 voxels, one bit each. Neighbours of
/// a voxel are found by a few bit operations on the bricks around it, not by one hash search each.
class VoxelBricks {
 public:
  static constexpr int kEdge = 4;

  /// A voxel: its brick and its place there, x + 4 y + 16 z.
  struct Place {
    std::uint32_t brick = 0;
    std::uint32_t bit = 0;
  };

  explicit VoxelBricks(std::size_t expected_bricks) : index_(expected_bricks) {}

  Place insert(const Eigen::Vector3i& voxel) {
    const Eigen::Vector3i key(voxel.x() >> 2, voxel.y() >> 2, voxel.z() >> 2);
    if (key != last_key_ || bricks_.empty()) {  // points come in rows: mostly it is the brick of the last one
      last_key_ = key;
      last_ = index_.insert(key);
      if (last_ == bricks_.size()) bricks_.push_back(0);
    }
    const auto bit = static_cast<std::uint32_t>((voxel.x() & 3) + 4 * (voxel.y() & 3) + 16 * (voxel.z() & 3));
    bricks_[last_] |= std::uint64_t{1} << bit;
    return {last_, bit};
  }

  /// To be called after the last insertion, before voxels are numbered.
  void number() {
    first_.resize(bricks_.size());
    voxels_ = 0;
    for (std::size_t b = 0; b < bricks_.size(); ++b) {
      first_[b] = voxels_;
      voxels_ += static_cast<std::uint32_t>(std::popcount(bricks_[b]));
    }
  }

  [[nodiscard]] std::uint32_t bricks() const { return static_cast<std::uint32_t>(bricks_.size()); }
  [[nodiscard]] std::uint32_t voxels() const { return voxels_; }
  [[nodiscard]] std::uint64_t bits(std::uint32_t brick) const { return bricks_[brick]; }
  /// The brick `step` bricks away; `VoxelIndex::kNone` if it holds nothing.
  [[nodiscard]] std::uint32_t neighbour(std::uint32_t brick, const Eigen::Vector3i& step) const {
    return index_.find(index_.key(brick) + step);
  }
  /// Number of a voxel that holds something.
  [[nodiscard]] std::uint32_t voxel(Place p) const {
    const std::uint64_t before = bricks_[p.brick] & ((std::uint64_t{1} << p.bit) - 1);
    return first_[p.brick] + static_cast<std::uint32_t>(std::popcount(before));
  }

 private:
  VoxelIndex index_;
  std::vector<std::uint64_t> bricks_;
  std::vector<std::uint32_t> first_;  ///< number of a brick's first voxel
  std::uint32_t voxels_ = 0;
  Eigen::Vector3i last_key_ = Eigen::Vector3i::Zero();
  std::uint32_t last_ = 0;
};

}  // namespace hoctomap
