// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/tabletop/StandingObjects.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "EnclosedPieces.h"
#include "ObjectCandidates.h"
#include "PatchClusters.h"
#include "ScanBlocks.h"
#include "ThinThings.h"
#include "Vessels.h"
#include "hoctomap/tabletop/EuclideanClusters.h"

namespace hoctomap {
namespace {

using Config = TabletopSegmentationConfig;

constexpr double kFoot = 0.02;       // m, height of an object's foot above its lowest point
constexpr double kThin = 0.01;       // m: what is thinner and
constexpr double kThinSize = 0.08;   // m: smaller is a scrap of something, not the top of an object
constexpr double kThinThing = 0.04;  // m, least size of what lies flat on a table
// Up to a view 60 degrees from above, a ball is seen down to half its radius.
constexpr double kRoundFoot = 0.5;
constexpr double kTop = 0.01;  // m, depth of an object's top below its highest points

double quantile(std::vector<double> values, double q) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Half of the narrower extent of a cluster, seen from above: twice the smaller standard deviation, which is
/// robust against stray points.
double halfWidth(const Cluster& cluster, const Measurement& z) {
  const auto n = static_cast<double>(cluster.size());
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& c : cluster) mean += z.world_points[c.point].head<2>().cast<double>() / n;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (const auto& c : cluster) {
    const Eigen::Vector2d d = z.world_points[c.point].head<2>().cast<double>() - mean;
    covariance += d * d.transpose() / n;
  }
  return 2.0 * std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(covariance).eigenvalues()[0]);
}

ClusterShape shapeOf(const Cluster& cluster, const Regions& regions, const std::vector<bool>& thin,
                     const Measurement& z, const Config& config) {
  ClusterShape shape;
  std::vector<double> heights;
  for (const auto& c : cluster) {
    heights.push_back(c.height);
    shape.box.extend(z.world_points[c.point].cast<double>());
    shape.range += c.range / static_cast<double>(cluster.size());
    shape.outside += !regions.inside[c.cell] || c.height > config.object_height_max;
    shape.under += c.height < 0.0;
    shape.thin += !thin.empty() && thin[c.point];
  }
  shape.lowest = std::max(0.0, quantile(heights, 0.02));
  shape.highest = quantile(std::move(heights), 0.95);
  std::size_t top = 0;
  for (const auto& c : cluster) {
    if (c.height >= 0.0 && c.height <= shape.lowest + kFoot) shape.foot.push_back(c.cell);
    top += c.height > shape.highest - kTop;
  }
  shape.half_width = halfWidth(cluster, z);
  shape.top_share = static_cast<double>(top) / static_cast<double>(cluster.size());
  return shape;
}

std::size_t countIn(const CellMask& mask, const std::vector<std::size_t>& cells) {
  return static_cast<std::size_t>(
      std::count_if(cells.begin(), cells.end(), [&](std::size_t cell) { return mask[cell] != 0; }));
}

/// High enough, or with the rim of a thin thing, and no scrap.
bool rises(const ClusterShape& shape, std::size_t points, const Config& config) {
  const double size = shape.box.sizes().maxCoeff();
  if (2 * shape.thin > points && size >= kThinThing) return true;
  return shape.highest >= config.certainHeight(shape.range) &&
         size >= (shape.highest - shape.lowest < kThin ? kThinSize : config.min_object_size);
}

/// Of an object's size, over the table and not through it.
bool couldBeObject(const ClusterShape& shape, const Regions& regions, std::size_t points,
                   const Config& config) {
  return points >= static_cast<std::size_t>(config.min_cluster_points) &&
         config.noise(shape.range) <= config.object_noise_max && rises(shape, points, config) &&
         shape.box.sizes().head<2>().norm() <= config.object_size_max && 3 * shape.outside <= points &&
         4 * shape.under <= points && 2 * countIn(regions.contact, shape.foot) > shape.foot.size();
}

/// The cells that a cluster covers, seen from above, and those that it hides from the sensor.
void addShadow(CellMask& shadow, const Cluster& cluster, const TableSurface& table, const Measurement& z) {
  const Eigen::Vector3d origin = z.origin();
  const double sensor_height = table.plane.signedDistance(origin);
  for (const auto& c : cluster) {
    shadow[c.cell] = 1;
    if (c.height <= 0.0 || c.height >= sensor_height) continue;
    const Eigen::Vector3d p = z.world_points[c.point].cast<double>();
    const Eigen::Vector3d crossing = origin + (p - origin) * (sensor_height / (sensor_height - c.height));
    const auto cell = table.grid.cellOf(crossing.x(), crossing.y());
    if (cell < shadow.size()) shadow[cell] = 1;
  }
}

/// Whether a cluster touches what is there, seen from above: it rests on it or is hidden by it.
bool meets(const CellMask& near, const Cluster& cluster) {
  const auto cells =
      std::count_if(cluster.begin(), cluster.end(), [&](const auto& c) { return near[c.cell] != 0; });
  return 10 * static_cast<std::size_t>(cells) >= cluster.size();
}

/// The clusters that stand on a table. One whose foot is not seen does if it is hidden by, or rests on, an
/// object that stands there: the rear and the upper parts of a heap.
std::vector<ShapedCluster> standing(std::vector<Cluster> clusters, const TableSurface& table,
                                    const Regions& regions, const std::vector<bool>& thin,
                                    const Measurement& z, const Config& config) {
  std::vector<ShapedCluster> objects;
  std::vector<ShapedCluster> lifted;
  CellMask shadow(table.grid.size(), 0);
  for (auto& cluster : clusters) {
    auto shape = shapeOf(cluster, regions, thin, z, config);
    if (!couldBeObject(shape, regions, cluster.size(), config)) continue;
    // A body that is as deep as it is round curves away below: of a ball, a view from above misses the foot.
    const double hidden_foot = kRoundFoot * shape.half_width;
    const bool on_table = shape.lowest <= config.contact_height + hidden_foot + config.noise(shape.range);
    if (on_table) addShadow(shadow, cluster, table, z);
    (on_table ? objects : lifted).push_back({std::move(cluster), std::move(shape)});
  }
  for (bool changed = true; changed;) {
    const CellMask near = table.grid.dilated(shadow, table.grid.cellSize());
    const auto rest = std::stable_partition(lifted.begin(), lifted.end(),
                                            [&](const auto& c) { return !meets(near, c.points); });
    changed = rest != lifted.end();
    for (auto it = rest; it != lifted.end(); ++it) {
      addShadow(shadow, it->points, table, z);
      objects.push_back(std::move(*it));
    }
    lifted.erase(rest, lifted.end());
  }
  return objects;
}

std::vector<Cluster> clustersOf(const std::vector<Candidate>& candidates, const Measurement& z,
                                double tolerance) {
  PointCloud points;
  points.reserve(candidates.size());
  for (const auto& c : candidates) points.push_back(z.world_points[c.point]);
  std::vector<Cluster> clusters;
  for (const auto& indices : euclideanClusters(points, tolerance)) {
    auto& cluster = clusters.emplace_back();
    for (const auto i : indices) cluster.push_back(candidates[i]);
  }
  return clusters;
}

/// Objects told apart by their distance, as in the paper.
std::vector<ShapedCluster> distantObjects(const ScanBlocks& scan, const TableSurface& table,
                                          const Regions& regions, const std::vector<bool>& taken,
                                          const Config& config) {
  auto candidates = objectCandidates(scan, table, regions, taken, config);
  dropFlatLayers(table, candidates, config);
  auto clusters = clustersOf(candidates, scan.z(), clusterTolerance(candidates, config));
  auto objects = standing(std::move(clusters), table, regions, {}, scan.z(), config);
  joinVessels(objects, scan.z(), config);
  return objects;
}

/// Objects told apart by their surfaces.
std::vector<ShapedCluster> convexObjects(const ScanBlocks& scan, const TableSurface& table,
                                         const Regions& regions, const std::vector<bool>& taken,
                                         const std::vector<bool>& in_object, const Config& config) {
  auto candidates = objectCandidates(scan, table, regions, taken, config);
  const auto near = pointsNearTable(scan, table, in_object, config);
  const TableRelief relief(table, near);
  auto things = thinThings(scan.z(), relief, near, candidates, config);
  std::vector<bool> thin(taken.size(), false);
  for (const auto& thing : things) {
    for (const auto& c : thing) thin[c.point] = true;
  }
  std::erase_if(candidates, [&](const Candidate& c) { return thin[c.point]; });
  auto clusters = patchClusters(scan.z(), table, relief, candidates, in_object, config);
  joinEnclosedPieces(clusters, scan.z());
  std::move(things.begin(), things.end(), std::back_inserter(clusters));
  return standing(std::move(clusters), table, regions, thin, scan.z(), config);
}

}  // namespace

std::vector<PointIndices> findStandingObjects(const Measurement& z, std::span<const TableSurface> tables,
                                              const TabletopSegmentationConfig& config) {
  std::vector<bool> taken(z.world_points.size(), false);
  std::vector<bool> in_object(z.world_points.size(), false);
  for (const auto& table : tables) {
    for (const auto i : table.points) taken[i] = true;
  }
  const ScanBlocks scan(z);
  std::vector<PointIndices> objects;
  for (const auto& table : tables) {
    const Regions regions(table);
    auto found = config.method == SegmentationMethod::euclidean
                     ? distantObjects(scan, table, regions, taken, config)
                     : convexObjects(scan, table, regions, taken, in_object, config);
    for (const auto& cluster : found) {
      auto& object = objects.emplace_back();
      for (const auto& c : cluster.points) {
        object.push_back(c.point);
        taken[c.point] = in_object[c.point] = true;
      }
    }
  }
  std::stable_sort(objects.begin(), objects.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return objects;
}

}  // namespace hoctomap
