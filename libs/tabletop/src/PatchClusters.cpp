// SPDX-License-Identifier: BSD-3-Clause
#include "PatchClusters.h"

#include "ConvexPatches.h"
#include "ObjectImage.h"

namespace hoctomap {
namespace {

// What objects enclose: from a fingertip to the floor of a large pan.
constexpr double kLeastIsland = 1.8e-4;  // m^2
constexpr double kMostIsland = 0.045;    // m^2

/// A point that an object encloses, as a candidate.
Candidate enclosed(const Measurement& z, const TableSurface& table, std::uint32_t point) {
  const Eigen::Vector3d p = z.world_points[point].cast<double>();
  return {point, table.grid.cellOf(p.x(), p.y()), table.plane.signedDistance(p), (p - z.origin()).norm()};
}

/// How far each pixel stands above the table, in units of the rise that is evidence there.
std::vector<float> risesOf(const Measurement& z, const TableSurface& table, const TableRelief& relief,
                           const ObjectImage& view, const TabletopSegmentationConfig& config) {
  std::vector<float> rises(view.image.size(), 0.0F);
  const Eigen::Vector3d origin = z.origin();
  const double drop = table.plane.signedDistance(origin);
  for (std::size_t i = 0; i < view.pixel_of_point.size(); ++i) {
    const auto pixel = view.pixel_of_point[i];
    if (pixel == ObjectImage::kNone || view.image.object[pixel]) continue;
    const Eigen::Vector3d p = z.world_points[i].cast<double>();
    const double rise = table.plane.signedDistance(p) - relief.at(p.x(), p.y());
    rises[pixel] = static_cast<float>(rise / config.leastRise((p - origin).norm(), drop));
  }
  return rises;
}

}  // namespace

std::vector<Cluster> patchClusters(const Measurement& z, const TableSurface& table, const TableRelief& relief,
                                   const std::vector<Candidate>& candidates, const std::vector<bool>& taken,
                                   const TabletopSegmentationConfig& config) {
  std::vector<Cluster> clusters;
  if (candidates.empty()) return clusters;
  ObjectImage view = objectImage(z, candidates);
  const auto seen = view.image.object;
  fillIslands(view.image, risesOf(z, table, relief, view, config), kLeastIsland, kMostIsland);
  const auto things = convexThings(view.image, config.range_noise);

  const auto add = [&](const Candidate& c, std::int32_t thing) {
    const auto k = static_cast<std::size_t>(thing);
    if (k >= clusters.size()) clusters.resize(k + 1);
    clusters[k].push_back(c);
  };
  auto next = candidates.begin();
  for (std::uint32_t i = 0; i < view.pixel_of_point.size(); ++i) {
    const bool is_candidate = next != candidates.end() && next->point == i;
    const auto candidate = is_candidate ? next++ : next;
    const auto pixel = view.pixel_of_point[i];
    if (pixel == ObjectImage::kNone || things[pixel] < 0) continue;
    if (is_candidate) {
      add(*candidate, things[pixel]);
    } else if (!seen[pixel] && !taken[i]) {
      const auto c = enclosed(z, table, i);
      if (c.cell < table.grid.size()) add(c, things[pixel]);
    }
  }
  std::erase_if(clusters, [](const Cluster& cluster) { return cluster.empty(); });
  return clusters;
}

}  // namespace hoctomap
