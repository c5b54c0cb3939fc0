// SPDX-License-Identifier: BSD-3-Clause
#include "SurfacePoints.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace hoctomap {

namespace {

/// Cells in a fixed order, in one word: points that lie more than 2^20 cells apart share cells at worst.
std::uint64_t cellKey(const Eigen::Vector3f& p, float spacing) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto cell = static_cast<std::int64_t>(std::floor(p[axis] / spacing));
    key = (key << 21U) | (static_cast<std::uint64_t>(cell + (1 << 20)) & 0x1FFFFFU);
  }
  return key;
}

}  // namespace

SurfacePoints::SurfacePoints(std::span<const Eigen::Vector3f> points, float spacing) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> cells;
  cells.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) cells.emplace_back(cellKey(points[i], spacing), i);
  std::sort(cells.begin(), cells.end());
  for (auto it = cells.begin(); it != cells.end();) {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    const auto first = it;
    for (; it != cells.end() && it->first == first->first; ++it) sum += points[it->second];
    points_.push_back(sum / static_cast<float>(it - first));
  }
  tree_.emplace(3, *this, nanoflann::KDTreeSingleIndexAdaptorParams(12));
}

std::optional<SurfacePoints::Neighbour> SurfacePoints::nearest(const Eigen::Vector3f& p, float radius) const {
  return nearestOf(p, radius, [](std::size_t) { return true; });
}

float SurfacePoints::distanceToNeighbour(const Eigen::Vector3f& p, std::size_t n) const {
  std::vector<std::uint32_t> indices(n + 1);
  std::vector<float> squared_distances(n + 1);
  const std::size_t found = tree_->knnSearch(p.data(), n + 1, indices.data(), squared_distances.data());
  return found == 0 ? 0.0F : std::sqrt(squared_distances[found - 1]);
}

PointCloud worldSurface(const MapHierarchy& hierarchy, NodeId id) {
  const Eigen::Isometry3f world_T_node = toIsometry(hierarchy.world_T_node(id)).cast<float>();
  PointCloud surface;
  const auto& voxels = hierarchy.node(id).map().occupiedVoxels();
  surface.reserve(voxels.size());
  for (const auto& voxel : voxels) surface.push_back(world_T_node * voxel);
  return surface;
}

}  // namespace hoctomap
