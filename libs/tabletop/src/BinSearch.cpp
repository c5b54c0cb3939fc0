// SPDX-License-Identifier: BSD-3-Clause
#include "BinSearch.h"

#include <algorithm>
#include <optional>

namespace hoctomap {
namespace {

constexpr int kMostPlanes = 12;            // RANSAC rounds of one scan
constexpr std::size_t kFewestSurfels = 5;  // that make a rim: most of its voxels hold a piece of wall, too
constexpr double kGap = 0.08;              // m between parts of one rim
constexpr double kHiddenGap = 0.30;        // m between parts of one rim behind an object
constexpr double kLeastRim = 0.015;        // m^2: half a metre of a rim of 3 cm
constexpr double kWall = 0.04;             // m, of the walls and what is wrong with their points
constexpr double kLowest = 0.02;           // share of the points in a bin that may be lower than its floor
constexpr double kSurround = 0.10;         // m around the rim that the grid covers

using Config = TabletopSegmentationConfig;

Eigen::AlignedBox2d around(std::span<const Eigen::Vector3d> points) {
  Eigen::AlignedBox2d region;
  for (const auto& p : points) region.extend(p.head<2>());
  return {region.min().array() - kSurround, region.max().array() + kSurround};
}

/// The cells within a rim, clear of the walls; none if it is no rim.
CellMask insideOf(const SurfaceGrid& grid, const CellMask& strip) {
  const CellMask hull = grid.hull(strip);
  std::size_t open = 0;
  CellMask walls(hull.size());
  for (std::size_t i = 0; i < hull.size(); ++i) {
    open += hull[i] && grid.at(i) == SurfaceGrid::Cell::open;
    walls[i] = !hull[i] || strip[i] ? 1 : 0;
  }
  if (2 * open < count(hull)) return CellMask(hull.size(), 0);
  CellMask inside = grid.dilated(walls, kWall);
  for (auto& cell : inside) cell = cell == 0;
  return inside;
}

/// Calls `visit(index, depth)` for the points over some cells, with their depth below a plane.
template <typename Visit>
void forPointsOver(const ScanBlocks& scan, const SurfaceGrid& grid, const CellMask& cells, const Plane& plane,
                   const Visit& visit) {
  const auto region = grid.bounds();
  scan.visit([&](const Eigen::AlignedBox3d& box) { return region.intersects(inPlan(box)); },
             [&](std::uint32_t i) {
               const Eigen::Vector3d p = scan.z().world_points[i].cast<double>();
               const auto cell = grid.cellOf(p.x(), p.y());
               if (cell < grid.size() && cells[cell]) visit(i, -plane.signedDistance(p));
             });
}

/// What lies within a rim as a table at the height of the lowest of it.
std::optional<TableSurface> floorOf(const ScanBlocks& scan, const Plane& rim, const SurfaceGrid& grid,
                                    const CellMask& strip, const Config& config) {
  const CellMask inside = insideOf(grid, strip);
  if (static_cast<double>(count(inside)) * grid.cellSize() * grid.cellSize() < config.min_table_area)
    return std::nullopt;
  std::vector<double> depths;
  forPointsOver(scan, grid, inside, rim, [&](std::uint32_t, double depth) {
    if (depth > 0.0 && depth < config.object_height_max) depths.push_back(depth);
  });
  if (static_cast<int>(depths.size()) < config.min_cluster_points) return std::nullopt;
  const auto lowest =
      depths.end() - 1 - static_cast<std::ptrdiff_t>(kLowest * static_cast<double>(depths.size()));
  std::nth_element(depths.begin(), lowest, depths.end());
  const Plane floor(rim.normal(), rim.offset() + *lowest);

  SurfaceGrid floor_grid(scan, floor, grid.bounds(), config);
  CellMask extent(floor_grid.size(), 0);
  CellMask patch(floor_grid.size(), 0);
  for (std::size_t i = 0; i < floor_grid.size(); ++i) {
    const Eigen::Vector2d at = floor_grid.center(i);
    const auto cell = grid.cellOf(at.x(), at.y());
    extent[i] = cell < grid.size() && inside[cell] ? 1 : 0;
    patch[i] = extent[i] && floor_grid.at(i) == SurfaceGrid::Cell::surface ? 1 : 0;
  }
  PointIndices points;
  const Eigen::Vector3d origin = scan.z().origin();
  forPointsOver(scan, floor_grid, patch, floor, [&](std::uint32_t i, double depth) {
    const Eigen::Vector3d p = scan.z().world_points[i].cast<double>();
    if (std::abs(depth) <= config.surfaceTolerance((p - origin).norm(), origin.z() - p.z()))
      points.push_back(i);
  });
  std::sort(points.begin(), points.end());
  return TableSurface{floor, std::move(floor_grid), std::move(patch), std::move(extent), std::move(points)};
}

bool isAtTableHeight(std::span<const Eigen::Vector3d> points, const Config& config) {
  double mean = 0.0;
  for (const auto& p : points) mean += p.z() / static_cast<double>(points.size());
  return mean >= config.table_height_min && mean <= config.table_height_max;
}

}  // namespace

std::vector<TableSurface> findBins(const ScanBlocks& scan, const Config& config) {
  std::mt19937_64 rng(config.seed);
  std::vector<TableSurface> bins;
  auto surfels = horizontalSurfels(scan.z(), config);
  for (int round = 0; round < kMostPlanes; ++round) {
    const auto rough = dominantPlane(surfels, config, rng);
    if (!rough) break;
    std::vector<Eigen::Vector3d> inliers;
    for (const auto& s : surfels) {
      if (rough->absDistance(s.centroid) < s.tolerance) inliers.push_back(s.centroid);
    }
    if (inliers.size() < kFewestSurfels) break;
    std::erase_if(surfels, [&](const Surfel& s) { return rough->absDistance(s.centroid) < s.tolerance; });
    const Plane rim = regressionPlane(inliers, config).value_or(*rough);
    const Eigen::AlignedBox2d region = around(inliers);
    if (!isAtTableHeight(inliers, config) ||
        region.sizes().maxCoeff() > config.object_size_max + 2.0 * kSurround)
      continue;
    const SurfaceGrid grid(scan, rim, region, config);
    const auto least = static_cast<std::size_t>(kLeastRim / (grid.cellSize() * grid.cellSize()));
    for (const CellMask& strip : grid.patches(kGap, kHiddenGap, least)) {
      if (auto floor = floorOf(scan, rim, grid, strip, config)) bins.push_back(std::move(*floor));
    }
  }
  return bins;
}

}  // namespace hoctomap
