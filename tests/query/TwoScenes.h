// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "hoctomap/hierarchy/MapHierarchy.h"
#include "support/RandomScenes.h"

namespace hoctomap::test {

/// A box or an upright cylinder of the true world.
struct Solid {
  Label label = labels::object;
  Eigen::Vector3d size{0.1, 0.1, 0.1};  ///< m; of a cylinder: diameter twice, height
  bool round = false;
  Eigen::Isometry3d world_T_centre = Eigen::Isometry3d::Identity();
};

/// The table comes first; its top is at z = 0.7 m. Below it the floor, z = 0.
using Solids = std::vector<Solid>;

/// A table of 1.0 x 1.2 m and `count` (at most 6) objects of different shapes that stand apart.
Solids randomTable(Rng& rng, std::size_t count);

/// Puts a solid on the table, turned by `yaw`.
Solid onTable(Eigen::Vector3d size, bool round, double x, double y, double yaw);

/// The world motion of a shift along the floor and a turn about the vertical through `centre`.
Eigen::Isometry3d slide(const Eigen::Vector3d& centre, double dx, double dy, double yaw);

/// Where cameras stand: `count` views evenly around the table, the first one at `degrees`.
std::vector<Eigen::Vector3d> viewsAround(std::size_t count, double degrees = 0.0);

/// The map that a perfect segmentation would make of these views: one node a solid that was seen, in its own
/// frame, and the background, cleared by all beams. `map_T_world`: the frame of the map is another one.
MapHierarchy mapOf(const Solids& solids, const std::vector<Eigen::Vector3d>& eyes, double resolution = 0.004,
                   const Eigen::Isometry3d& map_T_world = Eigen::Isometry3d::Identity());

}  // namespace hoctomap::test
