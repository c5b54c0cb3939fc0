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

/// Takes islands for objects, but those that do not rise above the table around them: these are a part of it.
void fillIslands(const Measurement& z, const TableSurface& table, const TableRelief& relief,
                 const TabletopSegmentationConfig& config, ObjectImage& view) {
  const auto islands = enclosedIslands(view.image, kLeastIsland, kMostIsland);
  if (islands.empty()) return;
  std::vector<std::uint32_t> island_of(view.image.size(), ObjectImage::kNone);
  for (std::uint32_t k = 0; k < islands.size(); ++k) {
    for (const auto pixel : islands[k]) island_of[pixel] = k;
  }
  struct Rise {
    double sum = 0.0;  ///< of the points, in units of the rise that is evidence there
    double points = 0.0;
  };
  std::vector<Rise> rises(islands.size());
  const Eigen::Vector3d origin = z.origin();
  const double drop = table.plane.signedDistance(origin);
  for (std::size_t i = 0; i < view.pixel_of_point.size(); ++i) {
    const auto pixel = view.pixel_of_point[i];
    if (pixel == ObjectImage::kNone || island_of[pixel] == ObjectImage::kNone) continue;
    const Eigen::Vector3d p = z.world_points[i].cast<double>();
    const double rise = table.plane.signedDistance(p) - relief.at(p.x(), p.y());
    auto& of_island = rises[island_of[pixel]];
    of_island.sum += rise / config.leastRise((p - origin).norm(), drop);
    of_island.points += 1.0;
  }
  for (std::size_t k = 0; k < islands.size(); ++k) {
    if (rises[k].sum < rises[k].points) continue;
    for (const auto pixel : islands[k]) view.image.object[pixel] = view.image.w[pixel] > 0.0F;
  }
}

}  // namespace

std::vector<Cluster> patchClusters(const Measurement& z, const TableSurface& table, const TableRelief& relief,
                                   const std::vector<Candidate>& candidates, const std::vector<bool>& taken,
                                   const TabletopSegmentationConfig& config) {
  std::vector<Cluster> clusters;
  if (candidates.empty()) return clusters;
  ObjectImage view = objectImage(z, candidates);
  const auto seen = view.image.object;
  fillIslands(z, table, relief, config, view);
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
