// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/exploration/TableArea.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace hoctomap {

namespace {

/// The height below which so much of the points lies.
double heightOfShare(std::vector<double> heights, double share) {
  const auto nth =
      heights.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(heights.size() - 1));
  std::nth_element(heights.begin(), nth, heights.end());
  return *nth;
}

}  // namespace

double TableArea::distanceTo(const Eigen::Vector2d& place) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& cell : outline) {
    // To the cell itself, a square, not to its middle.
    const Eigen::Vector2d beside = ((place - cell).cwiseAbs().array() - 0.5 * kOutlineCell).max(0.0);
    nearest = std::min(nearest, beside.norm());
  }
  return nearest;
}

std::optional<TableArea> tableArea(const MapHierarchy& map, NodeId table, const TableSpace& space) {
  const MapNode& node = map.node(table);
  const PointCloud& voxels = node.map().occupiedVoxels();
  if (voxels.empty()) return std::nullopt;
  const Eigen::Isometry3d world_T_node = toIsometry(map.world_T_node(table));
  TableArea area;
  area.node = table;
  std::vector<double> heights;
  heights.reserve(voxels.size());
  std::set<std::pair<int, int>> cells;
  for (const Eigen::Vector3f& voxel : voxels) {
    const Eigen::Vector3d p = world_T_node * voxel.cast<double>();
    heights.push_back(p.z());
    cells.emplace(static_cast<int>(std::floor(p.x() / kOutlineCell)),
                  static_cast<int>(std::floor(p.y() / kOutlineCell)));
  }
  constexpr double kUpperFace = 0.9;  // of the voxels lie below: stray ones above the face do not lift it
  area.top = heightOfShare(std::move(heights), kUpperFace) + 0.5 * node.map().resolution();
  Eigen::AlignedBox2d around;
  for (const auto& [x, y] : cells) {
    area.outline.emplace_back((x + 0.5) * kOutlineCell, (y + 0.5) * kOutlineCell);
    around.extend(area.outline.back());
  }
  area.center = around.center();
  const double beyond = 0.5 * kOutlineCell + space.margin;
  double ceiling = area.top + space.height;
  for (const NodeId child : node.children()) {
    const Eigen::AlignedBox3d box = worldBounds(map.box(child));
    if (!box.isEmpty()) ceiling = std::max(ceiling, box.max().z());
  }
  area.space = {Eigen::Vector3d(around.min().x() - beyond, around.min().y() - beyond, area.top),
                Eigen::Vector3d(around.max().x() + beyond, around.max().y() + beyond, ceiling)};
  return area;
}

std::vector<TableArea> tableAreas(const MapHierarchy& map, const TableSpace& space) {
  std::vector<TableArea> areas;
  for (const NodeId id : map.ids()) {
    if (map.node(id).label() != labels::table) continue;
    if (auto area = tableArea(map, id, space)) areas.push_back(std::move(*area));
  }
  return areas;
}

}  // namespace hoctomap
