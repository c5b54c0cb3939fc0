// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "hoctomap/exploration/TableArea.h"

namespace hoctomap::testing {

/// Sets the voxels of a tree whose centres lie in a box.
void setVoxels(octomap::OcTree& tree, const Eigen::AlignedBox3d& box, bool occupied);

/// A node map of boxes of voxels.
struct Boxes {
  std::vector<Eigen::AlignedBox3d> free;
  std::vector<Eigen::AlignedBox3d> occupied;
};
[[nodiscard]] NodeMap mapOf(double resolution, const Boxes& boxes);

[[nodiscard]] Eigen::AlignedBox3d box(double x0, double y0, double z0, double x1, double y1, double z1);

/// A floor of 4 x 4 m around the origin that has been seen free from 0.1 to 1.3 m, and a table of 1 x 0.6 m
/// in the middle, its upper face at 0.7 m.
[[nodiscard]] MapHierarchy roomWithTable();
inline constexpr NodeId kTable{1};

}  // namespace hoctomap::testing
