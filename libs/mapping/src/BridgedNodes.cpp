// SPDX-License-Identifier: BSD-3-Clause
#include "BridgedNodes.h"

#include <algorithm>
#include <cstdint>

#include "CellKey.h"
#include "SurfacePoints.h"

namespace hoctomap {
namespace {

constexpr float kCell = 0.04F;  // m: voxels of tables, and what their heights are off by from view to view

std::vector<std::uint64_t> cellsOf(std::span<const Eigen::Vector3f> points, int up = 0) {
  std::vector<std::uint64_t> cells;
  cells.reserve(points.size());
  for (const Eigen::Vector3f& p : points) {
    const Eigen::Vector3i cell = (p / kCell).array().floor().matrix().cast<int>();
    const std::uint64_t key = cellKey({cell.x(), cell.y(), cell.z() + up});
    if (cells.empty() || cells.back() != key) cells.push_back(key);  // neighbours often share one
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

}  // namespace

std::vector<NodeId> bridgedNodes(const MapHierarchy& hierarchy, std::span<const NodeId> nodes,
                                 std::span<const Eigen::Vector3f> world_points) {
  constexpr std::size_t kTenth = 10;
  constexpr std::size_t kHalf = 2;
  const auto seen = cellsOf(world_points);
  std::vector<std::uint64_t> reached = seen;  // and what is a cell higher or lower
  for (const int up : {-1, 1}) {
    const auto shifted = cellsOf(world_points, up);
    reached.insert(reached.end(), shifted.begin(), shifted.end());
  }
  std::sort(reached.begin(), reached.end());
  std::vector<NodeId> bridged;
  for (const NodeId id : nodes) {
    const auto known = cellsOf(worldSurface(hierarchy, id));
    const auto common =
        static_cast<std::size_t>(std::count_if(known.begin(), known.end(), [&](std::uint64_t cell) {
          return std::binary_search(reached.begin(), reached.end(), cell);
        }));
    if (common > 0 && (kTenth * common >= seen.size() || kHalf * common >= known.size()))
      bridged.push_back(id);
  }
  return bridged;
}

}  // namespace hoctomap
