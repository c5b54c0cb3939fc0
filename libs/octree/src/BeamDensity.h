// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "ScanMarks.h"

namespace hoctomap::engine {

/// Pages of a bitmap that an update takes at a time, 8 MB: more is done in parts.
inline constexpr double kMaxPagesAPart = 2048;

/// How densely the beams of a scan cross a box, on a coarse grid of at most 64^3 cells: a sample of the beams
/// is followed in steps of half a cell.
class BeamDensity {
 public:
  using Points = std::span<const Eigen::Vector3f>;

  /// @param max_samples steps along beams: about 5 ns each.
  BeamDensity(const ScanBeams& scan, const KeyBox& box, Points hits, Points passing, double max_samples);

  /// Expected pages of a bitmap (see VoxelBits).
  [[nodiscard]] double pages() const;
  /// Expected size of the tree of the box in bytes, as octomap's memoryUsage counts it.
  [[nodiscard]] double treeBytes() const;

 private:
  void add(const ScanBeams& scan, const Eigen::Vector3f& end);
  [[nodiscard]] double visits(std::uint32_t samples) const;

  KeyBox box_;
  int edge_;  ///< of a coarse cell, in voxels: a power of two
  unsigned levels_;
  std::array<int, 3> size_{};  ///< of the grid, in cells
  std::size_t stride_;         ///< one beam in so many is followed
  std::size_t hits_;
  std::vector<std::uint32_t> samples_;
};

}  // namespace hoctomap::engine
