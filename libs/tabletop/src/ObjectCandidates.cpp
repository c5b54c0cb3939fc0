// SPDX-License-Identifier: BSD-3-Clause
#include "ObjectCandidates.h"

#include <algorithm>
#include <cmath>

#include "ScanBlocks.h"

namespace hoctomap {
namespace {

constexpr double kOverhang = 0.04;     // m that a point of an object may lie beyond the table's outline
constexpr double kSurround = 0.20;     // m around the outline in which clusters are followed
constexpr double kBelow = 0.10;        // m under the table down to which they are followed
constexpr double kAbove = 0.05;        // m above the height limit up to which they are followed
constexpr double kFlatBreadth = 0.06;  // m, least breadth of a flat layer

std::vector<Candidate> pointsAround(const ScanBlocks& scan, const TableSurface& table, const Regions& regions,
                                    const std::vector<bool>& taken,
                                    const TabletopSegmentationConfig& config) {
  std::vector<Candidate> candidates;
  const Eigen::Vector3d origin = scan.z().origin();
  const double highest = config.object_height_max + kAbove;
  const auto isAround = [&, region = table.grid.bounds()](const Eigen::AlignedBox3d& box) {
    if (!region.intersects(inPlan(box))) return false;
    const Heights heights(table.plane, box);
    return heights.low <= highest && heights.high >= -kBelow;
  };
  scan.visit(isAround, [&](std::uint32_t i) {
    if (taken[i]) return;
    const Eigen::Vector3d p = scan.z().world_points[i].cast<double>();
    const double height = table.plane.signedDistance(p);
    if (height < -kBelow || height > highest) return;
    const auto cell = table.grid.cellOf(p.x(), p.y());
    if (cell >= table.grid.size() || !regions.around[cell]) return;
    const double range = (p - origin).norm();
    // Over the table, what is near its plane is its noise; beside it, a part of what passes by.
    if (table.extent[cell] && std::abs(height) <= config.surfaceTolerance(range, origin.z() - p.z())) return;
    candidates.push_back({i, cell, height, range});
  });
  return candidates;
}

/// Drops what has few neighbours of its kind in the image: flying pixels at depth edges and noise of the
/// table, which would tie objects together.
void dropLonePixels(const Measurement& z, std::vector<Candidate>& candidates) {
  if (!z.image) return;
  const int width = z.image->camera.width;
  const int height = z.image->camera.height;
  CellMask is_candidate(z.image->depth.size(), 0);
  for (const auto& c : candidates) is_candidate[z.pixel_of_point[c.point]] = 1;
  const auto lone = [&](const Candidate& c) {
    const int u = static_cast<int>(z.pixel_of_point[c.point]) % width;
    const int v = static_cast<int>(z.pixel_of_point[c.point]) / width;
    int valid = 0;
    int same = 0;
    for (int y = std::max(0, v - 1); y <= std::min(height - 1, v + 1); ++y) {
      for (int x = std::max(0, u - 1); x <= std::min(width - 1, u + 1); ++x) {
        valid += z.image->at(x, y) > 0.0F;
        same += is_candidate[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                             static_cast<std::size_t>(x)];
      }
    }
    return 2 * same < valid;
  };
  std::erase_if(candidates, lone);
}

}  // namespace

Regions::Regions(const TableSurface& table)
    : contact(table.grid.dilated(table.extent, table.grid.cellSize())),
      inside(table.grid.dilated(table.extent, kOverhang)),
      around(table.grid.dilated(table.extent, kSurround)) {}

std::vector<Candidate> objectCandidates(const ScanBlocks& scan, const TableSurface& table,
                                        const Regions& regions, const std::vector<bool>& taken,
                                        const TabletopSegmentationConfig& config) {
  auto candidates = pointsAround(scan, table, regions, taken, config);
  dropLonePixels(scan.z(), candidates);
  return candidates;
}

void dropFlatLayers(const TableSurface& table, std::vector<Candidate>& candidates,
                    const TabletopSegmentationConfig& config) {
  const auto& grid = table.grid;
  std::vector<int> excess(grid.size(), 0);  // points that are high, less those that are low
  CellMask not_flat(grid.size(), 1);
  const auto isLow = [&](const Candidate& c) {
    return c.height >= 0.0 && c.height < config.certainHeight(c.range);
  };
  for (const auto& c : candidates) excess[c.cell] += isLow(c) ? -1 : 1;
  for (const auto& c : candidates) not_flat[c.cell] = excess[c.cell] >= 0;
  // Opening: erode by half the breadth, and grow again what is left.
  CellMask flat = grid.dilated(not_flat, kFlatBreadth / 2.0 - grid.cellSize() / 2.0);
  for (auto& cell : flat) cell = cell == 0;
  flat = grid.dilated(flat, kFlatBreadth / 2.0 - grid.cellSize() / 2.0);
  std::erase_if(candidates,
                [&](const Candidate& c) { return flat[c.cell] && !not_flat[c.cell] && isLow(c); });
}

double clusterTolerance(std::vector<Candidate> candidates, const TabletopSegmentationConfig& config) {
  std::erase_if(candidates, [](const Candidate& c) { return c.height < 0.0; });
  if (candidates.empty()) return config.cluster_tolerance;
  const auto middle = candidates.begin() + static_cast<std::ptrdiff_t>(candidates.size() / 2);
  std::nth_element(candidates.begin(), middle, candidates.end(),
                   [](const auto& a, const auto& b) { return a.range < b.range; });
  return std::max(config.cluster_tolerance, config.noise(middle->range) * 2.0 / 3.0);  // two sigma
}

}  // namespace hoctomap
