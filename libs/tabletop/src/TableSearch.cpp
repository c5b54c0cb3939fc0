// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/tabletop/TableSearch.h"

#include <algorithm>
#include <cmath>

#include "BinSearch.h"
#include "ScanBlocks.h"
#include "TableTops.h"
#include "hoctomap/tabletop/EuclideanClusters.h"

namespace hoctomap {
namespace {

constexpr int kMostPlanes = 24;      // RANSAC rounds of one scan
constexpr double kGap = 0.08;        // m between parts of one table: seams, sparse rows of far pixels
constexpr double kHiddenGap = 0.30;  // m between parts of one table behind an object, whatever is around them
constexpr double kSurround = 0.30;   // m around the seen surface that the grid covers
constexpr double kFloor =
    0.10;  // m, |z| of what is the floor, if the band of table heights reaches down to it
constexpr std::size_t kMostCells = 1U << 24U;

using Config = TabletopSegmentationConfig;

Eigen::AlignedBox2d regionAround(std::span<const Eigen::Vector3d> points) {
  Eigen::AlignedBox2d region;
  for (const auto& p : points) region.extend(p.head<2>());
  return {region.min().array() - kSurround, region.max().array() + kSurround};
}

Eigen::AlignedBox2d regionAround(const SurfaceGrid& grid, const CellMask& mask) {
  Eigen::AlignedBox2d region;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask[i]) region.extend(grid.center(i));
  }
  return {region.min().array() - kSurround, region.max().array() + kSurround};
}

bool fits(const Eigen::AlignedBox2d& region, const Config& config) {
  return region.volume() / (config.outline_cell * config.outline_cell) < static_cast<double>(kMostCells);
}

/// m that a table is broader than what the noise of a wall leaves in its plane: that is as thin as the noise
/// is among thousands of points, nearly four standard deviations to either side, where it is largest.
double leastBreadth(const ScanBlocks& scan, const Plane& plane, const SurfaceGrid& grid,
                    const CellMask& patch, const Config& config) {
  constexpr double kLeastBreadth = 0.05;
  const Eigen::Vector3d origin = scan.z().origin();
  const double drop = plane.signedDistance(origin);
  double farthest = 0.0;  // in the plan
  for (std::size_t i = 0; i < patch.size(); ++i) {
    if (patch[i]) farthest = std::max(farthest, (grid.center(i) - origin.head<2>()).norm());
  }
  return std::max(kLeastBreadth, 2.5 * config.noise(std::hypot(farthest, drop)) + grid.cellSize());
}

/// What is left of the patch and its holes without a border of half the breadth.
CellMask coreOf(const SurfaceGrid& grid, const CellMask& patch, double breadth) {
  const CellMask closed = grid.extent(patch);
  CellMask gone(patch.size());
  for (std::size_t i = 0; i < patch.size(); ++i) gone[i] = closed[i] ? 0 : 1;
  gone = grid.dilated(gone, breadth / 2.0);
  for (auto& cell : gone) cell = cell ? 0 : 1;
  return gone;
}

/// Whether the patch is a surface and not a strip.
bool isBroad(const ScanBlocks& scan, const Plane& plane, const SurfaceGrid& grid, const CellMask& patch,
             const Config& config) {
  const CellMask core = coreOf(grid, patch, leastBreadth(scan, plane, grid, patch, config));
  return count(core) * 10 > count(patch);
}

/// The patch without the strips at its border: a wall beside a table at the wall.
CellMask withoutStrips(const ScanBlocks& scan, const Plane& plane, const SurfaceGrid& grid, CellMask patch,
                       const Config& config) {
  const double breadth = leastBreadth(scan, plane, grid, patch, config);
  const CellMask broad = grid.dilated(coreOf(grid, patch, breadth), breadth / 2.0);
  for (std::size_t i = 0; i < patch.size(); ++i) patch[i] = patch[i] && broad[i] ? 1 : 0;
  return patch;
}

/// Whether what parts the strips of a patch stands on the same surface: within its hull less is open than is
/// hidden, and of that, most lies under something. Two tables of one height that stand apart leave an open
/// gap beside the things that hide a part of it; what stands nearer to the sensor is not over them.
bool isCoveredBetween(const ScanBlocks& scan, const Plane& plane, const SurfaceGrid& grid,
                      const CellMask& patch, const Config& config) {
  CellMask gap = grid.hull(patch);
  std::size_t open = 0;
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < gap.size(); ++i) {
    gap[i] = gap[i] && !patch[i] ? 1 : 0;
    open += gap[i] && grid.at(i) == SurfaceGrid::Cell::open;
    hidden += gap[i] && grid.at(i) == SurfaceGrid::Cell::hidden;
  }
  if (open >= hidden) return false;
  CellMask covered(gap.size(), 0);
  const auto isOver = [&, region = grid.bounds()](const Eigen::AlignedBox3d& box) {
    return region.intersects(inPlan(box)) && Heights(plane, box).high > kSameTable;
  };
  scan.visit(isOver, [&](std::uint32_t i) {
    const Eigen::Vector3d p = scan.z().world_points[i].cast<double>();
    const auto cell = grid.cellOf(p.x(), p.y());
    if (cell >= gap.size() || !gap[cell]) return;
    const double height = plane.signedDistance(p);
    if (height <= kSameTable || height >= config.object_height_max) return;
    if (config.noise((p - scan.z().origin()).norm()) <= config.object_noise_max) covered[cell] = 1;
  });
  return 2 * count(covered) > hidden;
}

/// The parts of a surface that are tables of their own, largest first. Of a table that is seen only in strips
/// between things from its front to its back, all strips.
std::vector<CellMask> tablePatches(const ScanBlocks& scan, const Plane& plane, const SurfaceGrid& grid,
                                   std::size_t least, const Config& config) {
  constexpr std::size_t kStripShare = 4;  // a strip has at least this part of a table's least area
  auto strips = grid.patches(kGap, kHiddenGap, least / kStripShare);
  std::vector<CellMask> patches;
  for (const auto& around : grid.patches(kGap, std::max(kHiddenGap, config.object_size_max), least)) {
    CellMask joined(around.size(), 0);
    std::vector<CellMask> parts;
    for (auto& strip : strips) {
      const auto first = static_cast<std::size_t>(std::find(strip.begin(), strip.end(), 1) - strip.begin());
      if (first == strip.size() || !around[first] || !isBroad(scan, plane, grid, strip, config)) continue;
      for (std::size_t i = 0; i < joined.size(); ++i) joined[i] |= strip[i];
      parts.push_back(std::move(strip));
    }
    if (parts.size() > 1 && count(joined) >= least && isCoveredBetween(scan, plane, grid, joined, config)) {
      parts.assign(1, std::move(joined));
    }
    for (auto& part : parts) {
      if (count(part) >= least) patches.push_back(std::move(part));
    }
  }
  std::stable_sort(patches.begin(), patches.end(),
                   [](const auto& a, const auto& b) { return count(a) > count(b); });
  return patches;
}

/// Points of the patch: on the plane and over its cells or their neighbours, which hold the feet of objects.
PointIndices pointsOf(const ScanBlocks& scan, const Plane& plane, const SurfaceGrid& grid,
                      const CellMask& patch, const Config& config) {
  PointIndices points;
  const CellMask over = grid.dilated(patch, grid.cellSize());
  const Eigen::Vector3d origin = scan.z().origin();
  const auto isNear = [&, region = grid.bounds()](const Eigen::AlignedBox3d& box) {
    if (!region.intersects(inPlan(box))) return false;
    const Heights heights(plane, box);
    const double farthest = (origin - box.center()).norm() + box.sizes().norm() / 2.0;
    const double tolerance = config.largestTolerance(farthest * farthest);
    return heights.low <= tolerance && heights.high >= -tolerance;
  };
  scan.visit(isNear, [&](std::uint32_t i) {
    const Eigen::Vector3d p = scan.z().world_points[i].cast<double>();
    const double distance = plane.absDistance(p);
    if (distance > config.largestTolerance((p - origin).squaredNorm())) return;
    const auto cell = grid.cellOf(p.x(), p.y());
    if (cell >= over.size() || !over[cell]) return;
    if (distance <= config.surfaceTolerance((p - origin).norm(), origin.z() - p.z())) points.push_back(i);
  });
  return points;
}

/// The plane of a patch alone: two tables of one height need not have one tilt.
std::optional<Plane> refit(const Measurement& z, const PointIndices& points, const Config& config) {
  constexpr std::size_t kSample = 5000;
  const std::size_t step = std::max<std::size_t>(1, points.size() / kSample);
  std::vector<Eigen::Vector3d> sample;
  for (std::size_t i = 0; i < points.size(); i += step) {
    sample.push_back(z.world_points[points[i]].cast<double>());
  }
  return regressionPlane(sample, config);
}

double meanHeight(const SurfaceGrid& grid, const CellMask& patch, const Plane& plane) {
  double sum = 0.0;
  for (std::size_t i = 0; i < patch.size(); ++i) {
    if (!patch[i]) continue;
    const Eigen::Vector2d at = grid.center(i);
    sum -= (plane.normal().head<2>().dot(at) + plane.offset()) / plane.normal().z();
  }
  return sum / static_cast<double>(count(patch));
}

/// One patch of a plane found by RANSAC, made precise; nothing if it is no table.
std::optional<TableSurface> tableOf(const ScanBlocks& scan, const Plane& rough, const SurfaceGrid& rough_grid,
                                    const CellMask& rough_patch, const Config& config) {
  const auto plane = refit(scan.z(), pointsOf(scan, rough, rough_grid, rough_patch, config), config);
  if (!plane || plane->signedDistance(scan.z().origin()) <= kSameTable) return std::nullopt;
  SurfaceGrid grid(scan, *plane, regionAround(rough_grid, rough_patch), config);
  const double cell_area = grid.cellSize() * grid.cellSize();
  auto patches =
      tablePatches(scan, *plane, grid, static_cast<std::size_t>(config.min_table_area / cell_area), config);
  if (patches.empty()) return std::nullopt;
  CellMask patch = withoutStrips(scan, *plane, grid, std::move(patches.front()), config);
  if (count(patch) == 0) return std::nullopt;
  const double height = meanHeight(grid, patch, *plane);
  if (height < config.table_height_min || height > config.table_height_max) return std::nullopt;
  if (std::abs(height) < kFloor) return std::nullopt;
  CellMask extent = grid.extent(patch);
  auto points = pointsOf(scan, *plane, grid, patch, config);
  return TableSurface{*plane, std::move(grid), std::move(patch), std::move(extent), std::move(points)};
}

std::vector<TableSurface> tablesOf(const ScanBlocks& scan, const Plane& plane,
                                   std::span<const Eigen::Vector3d> inliers, const Config& config) {
  std::vector<TableSurface> tables;
  const auto region = regionAround(inliers);
  if (!fits(region, config)) return tables;
  const SurfaceGrid grid(scan, plane, region, config);
  const double cell_area = grid.cellSize() * grid.cellSize();
  // The plane is rough yet: half of the area will do.
  const auto least = static_cast<std::size_t>(config.min_table_area / cell_area / 2.0);
  for (const auto& patch : tablePatches(scan, plane, grid, least, config)) {
    if (auto table = tableOf(scan, plane, grid, patch, config)) tables.push_back(std::move(*table));
  }
  return tables;
}

/// Takes the surfels of a plane out of the search: of a table also those just above and below.
void removeExplained(std::vector<Surfel>& surfels, const Plane& plane,
                     const std::vector<TableSurface>& tables) {
  const auto explained = [&](const Surfel& s) {
    if (plane.absDistance(s.centroid) < s.tolerance) return true;
    return std::any_of(tables.begin(), tables.end(), [&](const TableSurface& t) {
      const auto cell = t.grid.cellOf(s.centroid.x(), s.centroid.y());
      return cell < t.grid.size() && t.extent[cell] && t.plane.absDistance(s.centroid) < kSameTable;
    });
  };
  std::erase_if(surfels, explained);
}

/// Parts of a plane that lie farther apart than an object is long, as indices into `inliers`.
std::vector<PointIndices> partsOf(std::span<const Eigen::Vector3d> inliers, const Config& config) {
  PointCloud flat;
  for (const auto& p : inliers) flat.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()), 0.0F);
  return euclideanClusters(flat, std::max(kHiddenGap, config.object_size_max) + Surfel::kSize);
}

}  // namespace

std::vector<TableSurface> findTables(const Measurement& z, const TabletopSegmentationConfig& config) {
  const ScanBlocks scan(z);
  std::mt19937_64 rng(config.seed);
  std::vector<TableSurface> tables;
  auto surfels = horizontalSurfels(z, config);
  for (int round = 0; round < kMostPlanes; ++round) {
    const auto plane = dominantPlane(surfels, config, rng);
    if (!plane) break;
    std::vector<Eigen::Vector3d> inliers;
    for (const auto& s : surfels) {
      if (plane->absDistance(s.centroid) < s.tolerance) inliers.push_back(s.centroid);
    }
    // A surfel covers its voxel at most, so a table needs at least this many.
    const double least = config.min_table_area / (Surfel::kSize * Surfel::kSize) / 2.0;
    if (static_cast<double>(inliers.size()) < least) break;
    for (const auto& part : partsOf(inliers, config)) {
      if (static_cast<double>(part.size()) < least) continue;
      std::vector<Eigen::Vector3d> centroids;
      for (const auto i : part) centroids.push_back(inliers[i]);
      const auto fitted = regressionPlane(centroids, config);
      for (auto& table : tablesOf(scan, fitted ? *fitted : *plane, centroids, config)) {
        tables.push_back(std::move(table));
      }
    }
    removeExplained(surfels, *plane, tables);
  }
  keepTables(scan, tables, config);
  return tables.empty() ? findBins(scan, config) : tables;
}

}  // namespace hoctomap
