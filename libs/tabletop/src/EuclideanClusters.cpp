// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/tabletop/EuclideanClusters.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "UnionFind.h"
#include "VoxelIndex.h"

namespace hoctomap {
namespace {

/// The points sorted by voxel: those of voxel v are `order[begin[v]] .. order[begin[v + 1]]`.
struct Buckets {
  VoxelIndex voxels;
  std::vector<std::uint32_t> voxel_of_point;
  std::vector<std::uint32_t> begin;
  std::vector<std::uint32_t> order;

  [[nodiscard]] std::span<const std::uint32_t> points(std::uint32_t voxel) const {
    return std::span(order).subspan(begin[voxel], begin[voxel + 1] - begin[voxel]);
  }
};

Buckets bucketPoints(std::span<const Eigen::Vector3f> points, double cell) {
  Buckets b{VoxelIndex(points.size() / 2), {}, {}, std::vector<std::uint32_t>(points.size())};
  b.voxel_of_point.reserve(points.size());
  for (const auto& p : points) {
    const Eigen::Array3d at = (p.cast<double>().array() / cell).floor();
    if (!(at.abs() < 1e9).all()) throw std::invalid_argument("euclideanClusters: point out of range");
    b.voxel_of_point.push_back(b.voxels.insert(at.cast<int>().matrix()));
  }
  b.begin.assign(b.voxels.size() + 1, 0);
  for (const auto v : b.voxel_of_point) ++b.begin[v + 1];
  for (std::size_t v = 0; v < b.voxels.size(); ++v) b.begin[v + 1] += b.begin[v];
  auto next = b.begin;
  for (std::uint32_t i = 0; i < points.size(); ++i) b.order[next[b.voxel_of_point[i]]++] = i;
  return b;
}

/// Half of the voxels in which a neighbour of a point of voxel 0 may lie, nearest first: joins across the
/// near ones make most searches across the far ones needless.
std::vector<Eigen::Vector3i> halfNeighbourhood() {
  std::vector<Eigen::Vector3i> offsets;
  for (int x = 0; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z)
        if (x > 0 || y > 0 || (y == 0 && z > 0)) offsets.emplace_back(x, y, z);
  std::stable_sort(offsets.begin(), offsets.end(),
                   [](const auto& a, const auto& b) { return a.squaredNorm() < b.squaredNorm(); });
  return offsets;
}

bool anyPairWithin(std::span<const Eigen::Vector3f> points, std::span<const std::uint32_t> a,
                   std::span<const std::uint32_t> b, double squared_tolerance) {
  for (const auto i : a) {
    const Eigen::Vector3d p = points[i].cast<double>();
    for (const auto j : b) {
      if ((points[j].cast<double>() - p).squaredNorm() <= squared_tolerance) return true;
    }
  }
  return false;
}

std::vector<PointIndices> collect(const Buckets& buckets, UnionFind& sets) {
  std::vector<PointIndices> clusters;
  std::vector<std::uint32_t> cluster_of_set(buckets.voxels.size(), VoxelIndex::kNone);
  for (std::uint32_t i = 0; i < buckets.voxel_of_point.size(); ++i) {
    auto& cluster = cluster_of_set[sets.find(buckets.voxel_of_point[i])];
    if (cluster == VoxelIndex::kNone) {
      cluster = static_cast<std::uint32_t>(clusters.size());
      clusters.emplace_back();
    }
    clusters[cluster].push_back(i);
  }
  return clusters;
}

}  // namespace

std::vector<PointIndices> euclideanClusters(std::span<const Eigen::Vector3f> points, double tolerance) {
  if (!(tolerance > 0.0)) throw std::invalid_argument("euclideanClusters: tolerance must be positive");
  // The diagonal of a voxel is a hair less than the tolerance, so that all points of a voxel are joined and
  // neighbours are at most two voxels away.
  const double cell = tolerance / std::sqrt(3.0) * (1.0 - 1e-5);
  const Buckets buckets = bucketPoints(points, cell);
  UnionFind sets(buckets.voxels.size());
  for (const auto& offset : halfNeighbourhood()) {
    for (std::uint32_t v = 0; v < buckets.voxels.size(); ++v) {
      const auto w = buckets.voxels.find(buckets.voxels.key(v) + offset);
      if (w == VoxelIndex::kNone || sets.find(v) == sets.find(w)) continue;
      if (anyPairWithin(points, buckets.points(v), buckets.points(w), tolerance * tolerance)) {
        sets.join(v, w);
      }
    }
  }
  return collect(buckets, sets);
}

}  // namespace hoctomap
