// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <vector>

#include "hoctomap/geometry/Measurement.h"
#include "hoctomap/tabletop/PlaneSearch.h"

namespace hoctomap {

/// A scan with its points in runs of neighbours, each with its box: what concerns one table passes over most
/// points of a scan without a look at them.
class ScanBlocks {
 public:
  static constexpr std::size_t kSize = 64;  ///< points a block

  /// Keeps a reference to the measurement.
  explicit ScanBlocks(const Measurement& z);

  [[nodiscard]] const Measurement& z() const { return z_; }

  /// Calls `visit(i)` for the points of all blocks of which `keep(box)` is true, ascending.
  template <typename Keep, typename Visit>
  void visit(const Keep& keep, const Visit& visit) const {
    for (std::size_t block = 0; block < boxes_.size(); ++block) {
      if (!keep(boxes_[block])) continue;
      const std::size_t end = std::min(z_.world_points.size(), (block + 1) * kSize);
      for (std::size_t i = block * kSize; i < end; ++i) visit(static_cast<std::uint32_t>(i));
    }
  }

 private:
  const Measurement& z_;
  std::vector<Eigen::AlignedBox3d> boxes_;  ///< world
};

/// The box seen from above.
[[nodiscard]] inline Eigen::AlignedBox2d inPlan(const Eigen::AlignedBox3d& box) {
  return {box.min().head<2>(), box.max().head<2>()};
}

/// Range of the signed distances of a box's points from a plane, a hair wider.
struct Heights {
  Heights(const Plane& plane, const Eigen::AlignedBox3d& box);

  double low;
  double high;
};

/// Box, in the plan, of the places where the lines from `origin` through the points of `box` cross the plane,
/// a hair larger; nothing is left out. Unbounded if some of them do not cross it.
[[nodiscard]] Eigen::AlignedBox2d crossings(const Plane& plane, const Eigen::Vector3d& origin,
                                            const Eigen::AlignedBox3d& box);

}  // namespace hoctomap
