// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "VoxelGrid.h"
#include "hoctomap/octree/ScanUpdate.h"

namespace hoctomap::engine {

/// The beams of a scan as octomap takes them: cut at the maximum range.
class ScanBeams {
 public:
  ScanBeams(const VoxelGrid& grid, const Beams& beams);

  [[nodiscard]] const VoxelGrid& grid() const { return grid_; }
  [[nodiscard]] const Eigen::Vector3f& origin() const { return beams_.origin; }
  /// Keys that the scan may change, but for the strays.
  [[nodiscard]] const KeyBox& box() const { return box_; }
  /// Free voxels outside `box()`. At the end of the key range octomap's keys wrap to the other end.
  [[nodiscard]] const std::vector<Key>& strays() const { return strays_; }
  /// Endpoints that no key can address.
  [[nodiscard]] std::size_t beyondKeyRange() const { return beyond_key_range_; }
  /// Whether beams may leave that box.
  [[nodiscard]] bool bounded() const { return beams_.bounds.has_value(); }
  [[nodiscard]] const Beams& beams() const { return beams_; }

  /// True if `end` is an endpoint that becomes occupied, not a point on a beam that goes on.
  [[nodiscard]] bool isTooLong(const Eigen::Vector3f& end) const {
    return beams_.max_range >= 0.0 && norm(end - beams_.origin) > beams_.max_range;
  }
  /// Where a beam ends: at its point, or at the maximum range.
  [[nodiscard]] Eigen::Vector3f end(const Eigen::Vector3f& p) const { return isTooLong(p) ? cut(p) : p; }
  [[nodiscard]] Eigen::Vector3f cut(const Eigen::Vector3f& end) const;

 private:
  // As octomap, with its order of operations: they decide the last bit of the new end.
  [[nodiscard]] static double norm(const Eigen::Vector3f& v) {
    return std::sqrt(static_cast<double>(v.x() * v.x() + v.y() * v.y() + v.z() * v.z()));
  }

  [[nodiscard]] bool allAddressable() const;
  void findOddities(const KeyBox& reach, const KeyBox& bounds);

  const VoxelGrid& grid_;
  const Beams& beams_;
  KeyBox box_;
  std::vector<Key> strays_;
  std::size_t beyond_key_range_ = 0;
};

}  // namespace hoctomap::engine
