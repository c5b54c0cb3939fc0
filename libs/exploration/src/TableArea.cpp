// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/exploration/TableArea.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace hoctomap {

namespace {

/// The upper side of the highest layer of voxels that is nearly as full as the fullest: noise makes the face
/// centimetres thick, with less and less above and below it.
double upperFace(const std::vector<double>& heights, double resolution) {
  constexpr double kNearlyFull = 0.9;
  std::map<int, std::size_t> layers;
  for (const double height : heights) ++layers[static_cast<int>(std::floor(height / resolution))];
  std::size_t fullest = 0;
  for (const auto& [layer, count] : layers) fullest = std::max(fullest, count);
  const auto face = std::find_if(layers.rbegin(), layers.rend(), [&](const auto& layer) {
    return static_cast<double>(layer.second) >= kNearlyFull * static_cast<double>(fullest);
  });
  double sum = 0.0;
  for (const double height : heights)
    if (static_cast<int>(std::floor(height / resolution)) == face->first) sum += height;
  return sum / static_cast<double>(face->second) + 0.5 * resolution;
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
  area.top = upperFace(heights, node.map().resolution());
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
