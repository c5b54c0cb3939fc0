// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/tabletop/TabletopSegmentation.h"

#include "Strays.h"
#include "hoctomap/tabletop/StandingObjects.h"
#include "hoctomap/tabletop/TableSearch.h"

namespace hoctomap {
namespace {

/// z_bg: all points that no other segment holds.
Segment remainderOf(const Measurement& z, const std::vector<TableSurface>& tables,
                    const std::vector<PointIndices>& objects) {
  std::vector<bool> taken(z.world_points.size(), false);
  for (const auto& table : tables) {
    for (const auto i : table.points) taken[i] = true;
  }
  for (const auto& object : objects) {
    for (const auto i : object) taken[i] = true;
  }
  Segment remainder{Structure::remainder, {}, std::nullopt};
  for (std::uint32_t i = 0; i < taken.size(); ++i) {
    if (!taken[i]) remainder.points.push_back(i);
  }
  return remainder;
}

/// Takes out of the tables what objects hold: the floors of pots lie in the plane of the table.
void yieldToObjects(std::size_t points, std::vector<TableSurface>& tables,
                    const std::vector<PointIndices>& objects) {
  std::vector<bool> in_object(points, false);
  for (const auto& object : objects) {
    for (const auto i : object) in_object[i] = true;
  }
  for (auto& table : tables) std::erase_if(table.points, [&](std::uint32_t i) { return in_object[i]; });
}

}  // namespace

std::vector<Segment> TabletopSegmentation::segment(const Measurement& z) const {
  auto tables = findTables(z, config_);
  auto objects = findStandingObjects(z, tables, config_);
  yieldToObjects(z.world_points.size(), tables, objects);
  if (config_.attach_strays) attachStrays(z, tables, objects, config_);

  std::vector<Segment> segments;  // Eq. (9): z_bg, z_table,1 .. z_table,n, z_obj,1 .. z_obj,m
  if (auto rest = remainderOf(z, tables, objects); !rest.points.empty()) segments.push_back(std::move(rest));
  for (auto& table : tables) segments.push_back({Structure::plane, std::move(table.points), table.plane});
  for (auto& object : objects) segments.push_back({Structure::cluster, std::move(object), std::nullopt});
  return segments;
}

}  // namespace hoctomap
