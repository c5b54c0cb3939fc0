// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/exploration/TraversabilityMap.h"

#include <algorithm>
#include <cmath>

#include "hoctomap/geometry/Errors.h"

namespace hoctomap {

namespace {

constexpr double kLargestMap = 100.0;  // m: beams that end far away do not make the grid huge

/// Where the map knows anything, and where the robot is; world x, y.
Eigen::AlignedBox2d extent(const MapHierarchy& map, const Eigen::Vector2d& robot, double margin) {
  Eigen::AlignedBox2d box(robot);
  const octomap::OcTree& background = map.root().map().tree();
  if (background.size() > 0) {
    Eigen::Vector3d low;
    Eigen::Vector3d high;
    background.getMetricMin(low.x(), low.y(), low.z());
    background.getMetricMax(high.x(), high.y(), high.z());
    box.extend(low.head<2>());
    box.extend(high.head<2>());
  }
  for (const NodeId id : map.ids()) {
    const Eigen::AlignedBox3d node = worldBounds(map.box(id));
    if (node.isEmpty()) continue;
    box.extend(node.min().head<2>());
    box.extend(node.max().head<2>());
  }
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(0.5 * kLargestMap);
  box = box.intersection(Eigen::AlignedBox2d(robot - reach, robot + reach));
  return {box.min() - Eigen::Vector2d::Constant(margin), box.max() + Eigen::Vector2d::Constant(margin)};
}

}  // namespace

TraversabilityMap::TraversabilityMap(const MapHierarchy& map, const TraversabilityConfig& config,
                                     double radius, double height, const Eigen::Vector2d& robot)
    : cell_(config.cell) {
  if (!(cell_ > 0.0)) throw ConfigError("[exploration] cell of the traversability map must be positive");
  const Eigen::AlignedBox2d box = extent(map, robot, radius + cell_);
  corner_ = (box.min() / cell_).array().floor() * cell_;
  width_ = static_cast<int>(std::ceil((box.max().x() - corner_.x()) / cell_));
  height_ = static_cast<int>(std::ceil((box.max().y() - corner_.y()) / cell_));
  states_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), State::unknown);
  project(map, config.lowest_obstacle, height);
  // The robot stands there.
  forEachWithin(robot, radius, [this](std::size_t i) { states_[i] = State::free; });

  traversable_.assign(states_.size(), false);
  for (std::size_t i = 0; i < states_.size(); ++i) {
    traversable_[i] = states_[i] == State::free || (config.unknown_is_free && states_[i] == State::unknown);
  }
  for (std::size_t i = 0; i < states_.size(); ++i) {
    if (states_[i] == State::occupied) blockAround(cell(i), radius);
  }
}

void TraversabilityMap::project(const MapHierarchy& map, double lowest, double highest) {
  const octomap::OcTree& background = map.root().map().tree();
  const auto columns = [this](double low, double high, double corner, int cells) {
    constexpr double kTouching = 1e-6;  // m: a leaf that ends at a cell's border is not in the next one
    return std::pair(std::max(0, static_cast<int>(std::floor((low - corner + kTouching) / cell_))),
                     std::min(cells - 1, static_cast<int>(std::floor((high - corner - kTouching) / cell_))));
  };
  for (auto leaf = background.begin_leafs(); leaf != background.end_leafs(); ++leaf) {
    const double half = 0.5 * leaf.getSize();
    if (leaf.getZ() + half <= lowest || leaf.getZ() - half >= highest) continue;
    const bool occupied = background.isNodeOccupied(*leaf);
    const auto [first_x, last_x] = columns(leaf.getX() - half, leaf.getX() + half, corner_.x(), width_);
    const auto [first_y, last_y] = columns(leaf.getY() - half, leaf.getY() + half, corner_.y(), height_);
    for (int y = first_y; y <= last_y; ++y) {
      for (int x = first_x; x <= last_x; ++x) {
        State& state = states_[index({x, y})];
        if (occupied) {
          state = State::occupied;
        } else if (state == State::unknown) {
          state = State::free;
        }
      }
    }
  }
  for (const NodeId id : map.ids()) {
    if (id == kRootId) continue;
    const Eigen::Isometry3d world_T_node = toIsometry(map.world_T_node(id));
    for (const Eigen::Vector3f& voxel : map.node(id).map().occupiedVoxels()) {
      const Eigen::Vector3d p = world_T_node * voxel.cast<double>();
      if (p.z() < lowest || p.z() > highest) continue;
      if (const auto at = cellOf(p.head<2>())) states_[index(*at)] = State::occupied;
    }
  }
}

std::optional<GridCell> TraversabilityMap::cellOf(const Eigen::Vector2d& place) const {
  const Eigen::Vector2d at = ((place - corner_) / cell_).array().floor();
  if (!(at.x() >= 0.0 && at.y() >= 0.0 && at.x() < width_ && at.y() < height_)) return std::nullopt;
  return GridCell{static_cast<int>(at.x()), static_cast<int>(at.y())};
}

Eigen::Vector2d TraversabilityMap::center(const GridCell& cell) const {
  return corner_ + cell_ * Eigen::Vector2d(cell.x + 0.5, cell.y + 0.5);
}

void TraversabilityMap::block(const Eigen::Vector2d& place, double radius) {
  forEachWithin(place, radius, [this](std::size_t i) { traversable_[i] = false; });
}

/// The obstacle may be anywhere in its cell.
void TraversabilityMap::blockAround(const GridCell& obstacle, double radius) {
  const int reach = static_cast<int>(radius / cell_) + 1;
  for (int y = std::max(0, obstacle.y - reach); y <= std::min(height_ - 1, obstacle.y + reach); ++y) {
    for (int x = std::max(0, obstacle.x - reach); x <= std::min(width_ - 1, obstacle.x + reach); ++x) {
      const double dx = std::max(0.0, std::abs(x - obstacle.x) - 0.5);
      const double dy = std::max(0.0, std::abs(y - obstacle.y) - 0.5);
      if (cell_ * std::hypot(dx, dy) <= radius) traversable_[index({x, y})] = false;
    }
  }
}

template <class Visit>
void TraversabilityMap::forEachWithin(const Eigen::Vector2d& place, double radius, Visit&& visit) const {
  const Eigen::Vector2d at = (place - corner_) / cell_;
  const double reach = radius / cell_;
  const auto clamped = [](double x, int cells) { return std::clamp(static_cast<int>(x), 0, cells - 1); };
  for (int y = clamped(at.y() - reach, height_); y <= clamped(at.y() + reach, height_); ++y) {
    for (int x = clamped(at.x() - reach, width_); x <= clamped(at.x() + reach, width_); ++x) {
      if ((center({x, y}) - place).squaredNorm() <= radius * radius) visit(index({x, y}));
    }
  }
}

}  // namespace hoctomap
