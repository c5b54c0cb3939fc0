// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/tabletop/EuclideanClusters.h"

#include <gtest/gtest.h>

#include <limits>
#include <nanoflann.hpp>
#include <stdexcept>

#include "support/RandomScenes.h"

namespace hoctomap {
namespace {

using test::Rng;
using test::uniform;

struct KdCloud {
  const PointCloud& points;
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return static_cast<double>(points[i][static_cast<Eigen::Index>(axis)]);
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using KdTree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, KdCloud>, KdCloud, 3,
                                                   std::size_t>;

/// Radius search and breadth-first growth: slow and obviously right.
std::vector<PointIndices> oracle(const PointCloud& points, double tolerance) {
  const KdCloud cloud{points};
  KdTree tree(3, cloud);
  tree.buildIndex();
  std::vector<bool> seen(points.size(), false);
  std::vector<PointIndices> clusters;
  for (std::uint32_t seed = 0; seed < points.size(); ++seed) {
    if (seen[seed]) continue;
    PointIndices cluster{seed};
    seen[seed] = true;
    for (std::size_t head = 0; head < cluster.size(); ++head) {
      const Eigen::Vector3d p = points[cluster[head]].cast<double>();
      std::vector<std::pair<std::size_t, double>> near;
      tree.radiusSearch(p.data(), tolerance * tolerance * 1.01, near, nanoflann::SearchParams());
      for (const auto& [i, unused] : near) {
        if (seen[i] || (points[i].cast<double>() - p).squaredNorm() > tolerance * tolerance) continue;
        seen[i] = true;
        cluster.push_back(static_cast<std::uint32_t>(i));
      }
    }
    std::sort(cluster.begin(), cluster.end());
    clusters.push_back(std::move(cluster));
  }
  return clusters;
}

TEST(EuclideanClusters, EqualTheOracleOnRandomClouds) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    // From scattered to nearly connected.
    const double extent = uniform(rng, 0.05, 0.4);
    PointCloud points;
    for (int i = 0; i < 3000; ++i) points.push_back(test::uniformVector(rng, -extent, extent).cast<float>());
    EXPECT_EQ(euclideanClusters(points, 0.02), oracle(points, 0.02)) << "seed " << seed;
  }
}

TEST(EuclideanClusters, EqualTheOracleOnSurfaces) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Rng rng(seed);
    PointCloud points;
    for (int k = 0; k < 12; ++k) {
      const auto box =
          test::boxSurface(rng,
                           {toIsometry(test::randomPose(rng, 0.15)),
                            {Eigen::Vector3d::Constant(-0.03), Eigen::Vector3d(0.03, 0.05, 0.1)}},
                           1500);
      points.insert(points.end(), box.begin(), box.end());
    }
    const auto clusters = euclideanClusters(points, 0.01);
    EXPECT_EQ(clusters, oracle(points, 0.01)) << "seed " << seed;
    EXPECT_LT(clusters.size(), points.size());
  }
}

TEST(EuclideanClusters, JoinAtTheToleranceAndNotBeyond) {
  // 0.25 is exact in binary, and so are these coordinates.
  const PointCloud points{{0, 0, 0}, {0.25F, 0, 0}, {0.5F, 0, 0}, {0.75F + 1e-6F, 0, 0}, {0, -0.25F, 0}};
  EXPECT_EQ(euclideanClusters(points, 0.25), (std::vector<PointIndices>{{0, 1, 2, 4}, {3}}));
}

TEST(EuclideanClusters, TakeDuplicatesSinglesAndNothing) {
  EXPECT_TRUE(euclideanClusters({}, 0.01).empty());
  const PointCloud same(5, Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(euclideanClusters(same, 0.01), (std::vector<PointIndices>{{0, 1, 2, 3, 4}}));
  const PointCloud apart{{0, 0, 0}, {-1, 0, 0}};
  EXPECT_EQ(euclideanClusters(apart, 0.01), (std::vector<PointIndices>{{0}, {1}}));
}

TEST(EuclideanClusters, RejectWhatHasNoAnswer) {
  const PointCloud one{{0, 0, 0}};
  EXPECT_THROW(static_cast<void>(euclideanClusters(one, 0.0)), std::invalid_argument);
  const PointCloud nan{{std::numeric_limits<float>::quiet_NaN(), 0, 0}};
  EXPECT_THROW(static_cast<void>(euclideanClusters(nan, 0.01)), std::invalid_argument);
  const PointCloud far{{1e9F, 0, 0}};
  EXPECT_THROW(static_cast<void>(euclideanClusters(far, 0.01)), std::invalid_argument);
}

}  // namespace
}  // namespace hoctomap
