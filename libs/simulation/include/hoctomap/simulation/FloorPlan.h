// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "hoctomap/simulation/Scene.h"

namespace hoctomap {

/// Where a round robot fits between the solids of a scene: the truth behind exploration's traversability map.
/// A grid of cells of 2 cm over the box around all solids; nothing beyond it can be driven on.
class FloorPlan {
 public:
  /// @param radius of the robot, m. @param lowest, highest: what lies lower or higher (world z, m) is no
  /// obstacle.
  FloorPlan(const Scene& scene, double radius, double lowest, double highest);

  /// True if the robot meets nothing with its centre there.
  [[nodiscard]] bool fits(const Eigen::Vector2d& place) const;

  /// Places to which the robot can drive from `start`, in no more than one cell of an even grid of `spacing`
  /// (m) each, by x, then y. Empty if it does not fit at `start`.
  [[nodiscard]] std::vector<Eigen::Vector2d> reachableFrom(const Eigen::Vector2d& start,
                                                           double spacing) const;

 private:
  struct Cell {
    int x;
    int y;
  };
  [[nodiscard]] Cell cellOf(const Eigen::Vector2d& place) const;
  [[nodiscard]] Eigen::Vector2d center(const Cell& cell) const;
  [[nodiscard]] bool inside(const Cell& cell) const;
  [[nodiscard]] std::size_t index(const Cell& cell) const;
  void block(const TriangleMesh& surface, const Eigen::Isometry3d& world_T_solid, double lowest,
             double highest);
  void grow(double radius);

  Eigen::Vector2d corner_ = Eigen::Vector2d::Zero();
  int width_ = 0;
  int height_ = 0;
  std::vector<bool> blocked_;
};

}  // namespace hoctomap
