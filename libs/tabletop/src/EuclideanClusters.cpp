// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/tabletop/EuclideanClusters.h"

#include <array>
#include <cmath>
#include <stdexcept>

#include "UnionFind.h"
#include "VoxelBricks.h"

namespace hoctomap {
namespace {

/// The points sorted by voxel: those of voxel v are `order[begin[v]] .. order[begin[v + 1]]`.
struct Buckets {
  VoxelBricks voxels;
  std::vector<std::uint32_t> voxel_of_point;
  std::vector<std::uint32_t> begin;
  std::vector<std::uint32_t> order;

  [[nodiscard]] std::span<const std::uint32_t> points(std::uint32_t voxel) const {
    return std::span(order).subspan(begin[voxel], begin[voxel + 1] - begin[voxel]);
  }
};

Buckets bucketPoints(std::span<const Eigen::Vector3f> points, double cell) {
  Buckets b{VoxelBricks(points.size() / 8), {}, {}, std::vector<std::uint32_t>(points.size())};
  std::vector<VoxelBricks::Place> places;
  places.reserve(points.size());
  for (const auto& p : points) {
    const Eigen::Array3d at = p.cast<double>().array() / cell;
    if (!(at.abs() < 1e9).all()) throw std::invalid_argument("euclideanClusters: point out of range");
    places.push_back(b.voxels.insert(floorOf(at.matrix())));
  }
  b.voxels.number();
  b.voxel_of_point.reserve(points.size());
  b.begin.assign(b.voxels.voxels() + 1, 0);
  for (const auto& place : places) {
    b.voxel_of_point.push_back(b.voxels.voxel(place));
    ++b.begin[b.voxel_of_point.back() + 1];
  }
  for (std::size_t v = 0; v < b.voxels.voxels(); ++v) b.begin[v + 1] += b.begin[v];
  auto next = b.begin;
  for (std::uint32_t i = 0; i < points.size(); ++i) b.order[next[b.voxel_of_point[i]]++] = i;
  return b;
}

/// Half of the voxels in which a neighbour of a point may lie (the other half finds it from the other side),
/// as bits of the bricks around the point's.
class HalfNeighbourhood {
 public:
  static constexpr std::size_t kSteps = 18;  ///< bricks from which any bit may be set: those with x >= 0

  /// Of voxels at most `farthest` apart along each axis, and more than `nearest` along one.
  constexpr HalfNeighbourhood(int nearest, int farthest) {
    for (int bit = 0; bit < 64; ++bit) {
      for (int x = 0; x <= farthest; ++x) {
        for (int y = -farthest; y <= farthest; ++y) {
          for (int z = -farthest; z <= farthest; ++z) {
            const bool first_half = x > 0 || y > 0 || (y == 0 && z > 0);
            const bool near = x <= nearest && y * y <= nearest * nearest && z * z <= nearest * nearest;
            if (first_half && !near) set(bit, x + bit % 4, y + bit / 4 % 4, z + bit / 16);
          }
        }
      }
    }
  }
  [[nodiscard]] constexpr std::uint64_t bits(std::size_t step, unsigned bit) const {
    return bits_[step][bit];
  }
  [[nodiscard]] static Eigen::Vector3i step(std::size_t i) {
    const auto n = static_cast<int>(i);
    return {n / 9, n / 3 % 3 - 1, n % 3 - 1};
  }

 private:
  /// Coordinates from the corner of the point's brick.
  constexpr void set(int bit, int x, int y, int z) {
    const int step = 9 * (x >> 2) + 3 * ((y >> 2) + 1) + (z >> 2) + 1;
    bits_[static_cast<std::size_t>(step)][static_cast<std::size_t>(bit)] |=
        std::uint64_t{1} << static_cast<unsigned>((x & 3) + 4 * (y & 3) + 16 * (z & 3));
  }
  std::array<std::array<std::uint64_t, 64>, kSteps> bits_{};
};

/// Visits all pairs of voxels that hold something and are neighbours, by their numbers.
template <typename Visit>
void forEachPair(const VoxelBricks& voxels, const HalfNeighbourhood& neighbourhood, const Visit& visit) {
  for (std::uint32_t brick = 0; brick < voxels.bricks(); ++brick) {
    std::array<std::uint32_t, HalfNeighbourhood::kSteps> around{};
    for (std::size_t s = 0; s < around.size(); ++s) {
      around[s] = voxels.neighbour(brick, HalfNeighbourhood::step(s));
    }
    for (std::uint64_t here = voxels.bits(brick); here != 0; here &= here - 1) {
      const auto bit = static_cast<std::uint32_t>(std::countr_zero(here));
      const std::uint32_t v = voxels.voxel({brick, bit});
      for (std::size_t s = 0; s < around.size(); ++s) {
        if (around[s] == VoxelIndex::kNone) continue;
        std::uint64_t there = voxels.bits(around[s]) & neighbourhood.bits(s, bit);
        for (; there != 0; there &= there - 1) {
          visit(v, voxels.voxel({around[s], static_cast<std::uint32_t>(std::countr_zero(there))}));
        }
      }
    }
  }
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
  std::vector<std::uint32_t> cluster_of_set(buckets.voxels.voxels(), VoxelIndex::kNone);
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
  UnionFind sets(buckets.voxels.voxels());
  // Nearest first: joins across near voxels make most searches across the far ones needless.
  static constexpr HalfNeighbourhood kNear(0, 1);
  static constexpr HalfNeighbourhood kFar(1, 2);
  for (const auto* neighbourhood : {&kNear, &kFar}) {
    forEachPair(buckets.voxels, *neighbourhood, [&](std::uint32_t v, std::uint32_t w) {
      if (sets.find(v) == sets.find(w)) return;
      if (anyPairWithin(points, buckets.points(v), buckets.points(w), tolerance * tolerance)) sets.join(v, w);
    });
  }
  return collect(buckets, sets);
}

}  // namespace hoctomap
