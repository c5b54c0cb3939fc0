// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "hoctomap/octree/OccupancyModel.h"
#include "hoctomap/octree/ScanUpdate.h"
#include "support/RandomScenes.h"

namespace hoctomap {
namespace {

std::string otBytes(const octomap::OcTree& tree) {
  std::ostringstream out;
  tree.write(out);
  return out.str();
}

PointCloud randomEndpoints(test::Rng& rng, std::size_t count, double extent) {
  PointCloud points;
  for (std::size_t i = 0; i < count; ++i) {
    points.push_back(test::uniformVector(rng, -extent, extent).cast<float>());
  }
  return points;
}

void insertWithStock(octomap::OcTree& tree, const Beams& beams) {
  octomap::Pointcloud cloud;
  for (const auto& p : beams.hits) cloud.push_back(p.x(), p.y(), p.z());
  tree.insertPointCloud(cloud, {beams.origin.x(), beams.origin.y(), beams.origin.z()}, beams.max_range);
}

TEST(ReferenceScanUpdate, UnboundedEqualsStockInsertPointCloud) {
  const auto engine = makeReferenceScanUpdate();
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    test::Rng rng(seed);
    const double resolution = std::array{0.01, 0.05, 0.2}[seed % 3];
    octomap::OcTree ours(resolution);
    octomap::OcTree stock(resolution);
    for (int scan = 0; scan < 4; ++scan) {
      PointCloud hits = randomEndpoints(rng, 150, 1.0);
      hits.push_back(hits.front());  // a duplicate
      Beams beams;
      beams.origin = test::uniformVector(rng, -0.5, 0.5).cast<float>();
      hits.push_back(beams.origin);  // a beam of no length
      beams.hits = hits;
      beams.max_range = seed % 2 == 0 ? -1.0 : 0.9;
      engine->apply(ours, beams);
      insertWithStock(stock, beams);
      ASSERT_EQ(otBytes(ours), otBytes(stock)) << "seed " << seed << ", scan " << scan;
    }
    EXPECT_GT(ours.size(), 100U);
  }
}

/// Brute force: the state of every voxel from the definition in ScanUpdate.h, with none of the engine's sets.
TEST(ReferenceScanUpdate, BoundedEqualsTheDefinitionVoxelByVoxel) {
  const auto engine = makeReferenceScanUpdate();
  const OccupancyModel model;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    test::Rng rng(100 + seed);
    const PointCloud hits = randomEndpoints(rng, 40, 0.6);
    const PointCloud passing = randomEndpoints(rng, 40, 0.9);
    const PointCloud endpoints = randomEndpoints(rng, 20, 0.6);
    Beams beams;
    beams.origin = Eigen::Vector3f(1.0F, 0.2F, 0.3F);
    beams.hits = hits;
    beams.passing = passing;
    beams.endpoints = endpoints;
    beams.bounds =
        Eigen::AlignedBox3d(Eigen::Vector3d(-0.33, -0.41, -0.27), Eigen::Vector3d(0.38, 0.29, 0.44));
    octomap::OcTree tree(0.05);
    model.applyTo(tree);
    engine->apply(tree, beams);

    const auto less = [](const octomap::OcTreeKey& a, const octomap::OcTreeKey& b) {
      return std::lexicographical_compare(a.k, a.k + 3, b.k, b.k + 3);
    };
    std::map<octomap::OcTreeKey, bool, decltype(less)> expected(less);
    const octomap::point3d origin(beams.origin.x(), beams.origin.y(), beams.origin.z());
    const auto inside = [&](const octomap::OcTreeKey& k) {
      const auto low =
          tree.coordToKey(beams.bounds->min().x(), beams.bounds->min().y(), beams.bounds->min().z());
      const auto high =
          tree.coordToKey(beams.bounds->max().x(), beams.bounds->max().y(), beams.bounds->max().z());
      return k[0] >= low[0] && k[1] >= low[1] && k[2] >= low[2] && k[0] <= high[0] && k[1] <= high[1] &&
             k[2] <= high[2];
    };
    for (const PointCloud* cloud : {&hits, &passing}) {
      for (const auto& p : *cloud) {
        octomap::KeyRay ray;
        tree.computeRayKeys(origin, {p.x(), p.y(), p.z()}, ray);
        for (const auto& key : ray) {
          if (inside(key)) expected.emplace(key, false);
        }
      }
    }
    for (const PointCloud* cloud : {&hits, &endpoints}) {
      for (const auto& p : *cloud) {
        const auto key = tree.coordToKey(p.x(), p.y(), p.z());
        if (inside(key)) expected[key] = true;
      }
    }
    tree.expand();
    EXPECT_EQ(tree.getNumLeafNodes(), expected.size());
    for (const auto& [key, occupied] : expected) {
      const auto* node = tree.search(key);
      ASSERT_NE(node, nullptr);
      EXPECT_EQ(node->getLogOdds(), occupied ? tree.getProbHitLog() : tree.getProbMissLog());
    }
  }
}

TEST(ReferenceScanUpdate, EndpointsBeyondTheKeyRangeAreCountedAndCarveNothing) {
  octomap::OcTree tree(0.001);
  const PointCloud hits{{40.0F, 0.0F, 0.0F}, {0.1F, 0.0F, 0.0F}};
  Beams beams;
  beams.hits = hits;
  const ScanUpdateReport report = makeReferenceScanUpdate()->apply(tree, beams);
  EXPECT_EQ(report.beyond_key_range, 1U);
  EXPECT_EQ(tree.search(0.2, 0.0, 0.0), nullptr);
  ASSERT_NE(tree.search(0.1F, 0.0F, 0.0F), nullptr);
}

TEST(ReferenceScanUpdate, AVoxelIsUpdatedOnceAScanAndOccupiedWins) {
  octomap::OcTree tree(0.1);
  // The second beam passes through the voxel that the first one ends in; the third ends there again.
  const PointCloud hits{{0.55F, 0.05F, 0.05F}, {0.95F, 0.05F, 0.05F}, {0.56F, 0.05F, 0.05F}};
  Beams beams;
  beams.origin = Eigen::Vector3f(0.05F, 0.05F, 0.05F);
  beams.hits = hits;
  makeReferenceScanUpdate()->apply(tree, beams);
  EXPECT_EQ(tree.search(0.55F, 0.05F, 0.05F)->getLogOdds(), tree.getProbHitLog());
  EXPECT_EQ(tree.search(0.35F, 0.05F, 0.05F)->getLogOdds(), tree.getProbMissLog());
}

}  // namespace
}  // namespace hoctomap
