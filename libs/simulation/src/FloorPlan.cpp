// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/simulation/FloorPlan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <set>
#include <utility>

namespace hoctomap {
namespace {

constexpr double kCell = 0.02;  // m

Eigen::AlignedBox3d boxAround(const Scene& scene) {
  Eigen::AlignedBox3d box;
  for (const SolidId id : scene.ids())
    if (scene.present(id))
      box.extend(surfaceExtent(*scene.solid(id).surface, toIsometry(scene.world_T_solid(id))).box);
  return box;
}

}  // namespace

FloorPlan::FloorPlan(const Scene& scene, double radius, double lowest, double highest) {
  const Eigen::AlignedBox3d box = boxAround(scene);
  if (box.isEmpty()) return;
  corner_ = box.min().head<2>();
  width_ = static_cast<int>(std::ceil(box.sizes().x() / kCell));
  height_ = static_cast<int>(std::ceil(box.sizes().y() / kCell));
  blocked_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), false);
  for (const SolidId id : scene.ids())
    if (scene.present(id))
      block(*scene.solid(id).surface, toIsometry(scene.world_T_solid(id)), lowest, highest);
  grow(radius);
}

bool FloorPlan::fits(const Eigen::Vector2d& place) const {
  const Cell cell = cellOf(place);
  return inside(cell) && !blocked_[index(cell)];
}

std::vector<Eigen::Vector2d> FloorPlan::reachableFrom(const Eigen::Vector2d& start, double spacing) const {
  if (!fits(start)) return {};
  std::vector<bool> reached(blocked_.size(), false);
  std::deque<Cell> front{cellOf(start)};
  reached[index(front.front())] = true;
  // Counted from the world's origin, so that places do not depend on where the box begins.
  std::set<std::pair<long, long>> places;
  while (!front.empty()) {
    const Cell cell = front.front();
    front.pop_front();
    const Eigen::Vector2d place = center(cell) / spacing;
    const std::pair<long, long> nearest(std::lround(place.x()), std::lround(place.y()));
    if (!places.contains(nearest) && fits(spacing * Eigen::Vector2d(static_cast<double>(nearest.first),
                                                                    static_cast<double>(nearest.second))))
      places.insert(nearest);
    for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
      const Cell next{cell.x + dx, cell.y + dy};
      if (!inside(next) || blocked_[index(next)] || reached[index(next)]) continue;
      reached[index(next)] = true;
      front.push_back(next);
    }
  }
  std::vector<Eigen::Vector2d> result;
  for (const auto& [x, y] : places)
    result.emplace_back(spacing * static_cast<double>(x), spacing * static_cast<double>(y));
  return result;
}

FloorPlan::Cell FloorPlan::cellOf(const Eigen::Vector2d& place) const {
  const Eigen::Vector2d p = (place - corner_) / kCell;
  return {static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y()))};
}

Eigen::Vector2d FloorPlan::center(const Cell& cell) const {
  return corner_ + kCell * Eigen::Vector2d(cell.x + 0.5, cell.y + 0.5);
}

bool FloorPlan::inside(const Cell& cell) const {
  return cell.x >= 0 && cell.y >= 0 && cell.x < width_ && cell.y < height_;
}

std::size_t FloorPlan::index(const Cell& cell) const {
  return static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(width_) +
         static_cast<std::size_t>(cell.x);
}

/// Marks the cells under the part of a surface that lies between the heights, by points no farther apart than
/// half a cell.
void FloorPlan::block(const TriangleMesh& surface, const Eigen::Isometry3d& world_T_solid, double lowest,
                      double highest) {
  for (const auto& triangle : surface.triangles) {
    std::array<Eigen::Vector3d, 3> p;
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = world_T_solid * surface.vertices[triangle[i]].cast<double>();
      box.extend(p[i]);
    }
    if (box.max().z() < lowest || box.min().z() > highest) continue;
    const double longest = std::max({(p[1] - p[0]).norm(), (p[2] - p[1]).norm(), (p[0] - p[2]).norm()});
    const int steps = static_cast<int>(std::ceil(longest / (0.5 * kCell)));
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j) {
        const double a = static_cast<double>(i) / steps;
        const double b = static_cast<double>(j) / steps;
        const Eigen::Vector3d q = p[0] + a * (p[1] - p[0]) + b * (p[2] - p[0]);
        const Cell cell = cellOf(q.head<2>());
        if (q.z() >= lowest && q.z() <= highest && inside(cell)) blocked_[index(cell)] = true;
      }
  }
}

void FloorPlan::grow(double radius) {
  const auto reach = static_cast<int>(std::ceil(radius / kCell));
  std::vector<Cell> disc;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x)
      if (kCell * std::hypot(x, y) <= radius) disc.push_back({x, y});
  const std::vector<bool> obstacles = blocked_;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      if (!obstacles[index({x, y})]) continue;
      for (const Cell& d : disc)
        if (const Cell cell{x + d.x, y + d.y}; inside(cell)) blocked_[index(cell)] = true;
    }
}

}  // namespace hoctomap
