// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {

struct TraversabilityConfig {
  double cell = 0.05;            ///< m
  double lowest_obstacle = 0.1;  ///< m above the floor: what is lower is driven over
  bool unknown_is_free = false;  ///< whether the robot may go where no column has been seen
};

struct GridCell {
  int x = 0;
  int y = 0;
  auto operator<=>(const GridCell&) const = default;
};

/// The 2D grid m_trav of Section V: all obstacles of the hierarchy that the robot could hit, projected onto
/// the floor (world z = 0) and grown by the robot's radius.
///
/// A cell is *free* if something of its column was seen free and nothing in it occupied, between the lowest
/// obstacle and the robot's height; the robot's own footprint is free. The floor itself is seen seldom and is
/// not asked for.
class TraversabilityMap {
 public:
  enum class State : std::uint8_t { unknown, free, occupied };

  /// @param radius, height of the robot, m. @param robot where it stands, world x, y.
  TraversabilityMap(const MapHierarchy& map, const TraversabilityConfig& config, double radius, double height,
                    const Eigen::Vector2d& robot);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] double cellSize() const { return cell_; }
  /// World x, y of the corner of cell (0, 0) with the smallest coordinates.
  [[nodiscard]] const Eigen::Vector2d& corner() const { return corner_; }

  [[nodiscard]] std::optional<GridCell> cellOf(const Eigen::Vector2d& place) const;
  [[nodiscard]] Eigen::Vector2d center(const GridCell& cell) const;
  /// Row-major place of a cell, and back.
  [[nodiscard]] std::size_t index(const GridCell& cell) const {
    return static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(cell.x);
  }
  [[nodiscard]] GridCell cell(std::size_t index) const {
    return {static_cast<int>(index % static_cast<std::size_t>(width_)),
            static_cast<int>(index / static_cast<std::size_t>(width_))};
  }
  [[nodiscard]] std::size_t cells() const { return states_.size(); }

  /// Before growing by the radius.
  [[nodiscard]] State state(const GridCell& cell) const { return states_[index(cell)]; }
  /// True if the robot can stand with its centre in the cell's middle, wherever in their cells the obstacles
  /// are.
  [[nodiscard]] bool traversable(const GridCell& cell) const { return traversable_[index(cell)]; }
  /// Takes a cell, and what lies within `radius` m of it, out: the robot could not get there.
  void block(const Eigen::Vector2d& place, double radius);

 private:
  void blockAround(const GridCell& obstacle, double radius);
  void project(const MapHierarchy& map, double lowest, double highest);
  /// Calls `visit(index)` for the cells whose centres lie within a radius.
  template <class Visit>
  void forEachWithin(const Eigen::Vector2d& place, double radius, Visit&& visit) const;

  double cell_;
  Eigen::Vector2d corner_;
  int width_ = 0;
  int height_ = 0;
  std::vector<State> states_;
  std::vector<bool> traversable_;
};

}  // namespace hoctomap
