// SPDX-License-Identifier: BSD-3-Clause
#include "TableTops.h"

#include <algorithm>

namespace hoctomap {
namespace {

using Config = TabletopSegmentationConfig;

/// How one table lies over another.
struct Overlap {
  std::size_t over =
      0;  ///< cells of the upper one over the lower one's outline, less than an object's height above
  double height = 0.0;  ///< m, their mean height above it
};

Overlap overlap(const TableSurface& upper, const TableSurface& lower, const Config& config) {
  Overlap result;
  for (std::size_t i = 0; i < upper.patch.size(); ++i) {
    if (!upper.patch[i]) continue;
    const Eigen::Vector2d at = upper.grid.center(i);
    const auto cell = lower.grid.cellOf(at.x(), at.y());
    if (cell >= lower.grid.size() || !lower.extent[cell]) continue;
    const double z =
        -(upper.plane.normal().head<2>().dot(at) + upper.plane.offset()) / upper.plane.normal().z();
    const double height = lower.plane.signedDistance({at.x(), at.y(), z});
    if (height <= -kSameTable || height >= config.object_height_max) continue;
    ++result.over;
    result.height += height;
  }
  if (result.over > 0) result.height /= static_cast<double>(result.over);
  return result;
}

/// Whether there is room under a surface, into which the sensor looks: it is a shelf, and not the top of a
/// solid thing, whose lid reaches a few centimetres beyond its sides at most.
bool hasRoomBelow(const ScanBlocks& scan, const TableSurface& table) {
  constexpr double kLid = 0.06;        // m
  constexpr double kRoom = 0.05;       // m under the surface: thicker than a board
  constexpr double kLeastArea = 0.01;  // m^2 of it into which beams go
  CellMask beside(table.extent.size());
  for (std::size_t i = 0; i < beside.size(); ++i) beside[i] = table.extent[i] ? 0 : 1;
  beside = table.grid.dilated(beside, kLid);
  CellMask seen(beside.size(), 0);
  const auto isBelow = [&, region = table.grid.bounds()](const Eigen::AlignedBox3d& box) {
    return region.intersects(inPlan(box)) && Heights(table.plane, box).low < -kRoom;
  };
  scan.visit(isBelow, [&](std::uint32_t i) {
    const Eigen::Vector3d p = scan.z().world_points[i].cast<double>();
    const auto cell = table.grid.cellOf(p.x(), p.y());
    if (cell < seen.size() && !beside[cell] && table.plane.signedDistance(p) < -kRoom) seen[cell] = 1;
  });
  return static_cast<double>(count(seen)) * table.grid.cellSize() * table.grid.cellSize() > kLeastArea;
}

}  // namespace

void keepTables(const ScanBlocks& scan, std::vector<TableSurface>& tables, const Config& config) {
  std::stable_sort(tables.begin(), tables.end(),
                   [](const auto& a, const auto& b) { return count(a.patch) > count(b.patch); });
  std::vector<bool> is_top(tables.size(), false);
  for (std::size_t k = 0; k < tables.size(); ++k) {
    for (std::size_t lower = 0; lower < tables.size() && !is_top[k]; ++lower) {
      if (lower == k) continue;
      const Overlap o = overlap(tables[k], tables[lower], config);
      if (2 * o.over <= count(tables[k].patch)) continue;
      is_top[k] = o.height > kSameTable ? !hasRoomBelow(scan, tables[k]) : lower < k;
    }
  }
  std::vector<TableSurface> kept;
  for (std::size_t k = 0; k < tables.size(); ++k) {
    if (!is_top[k]) kept.push_back(std::move(tables[k]));
  }
  tables = std::move(kept);
}

}  // namespace hoctomap
