// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/octree/NodeMap.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "block_scenes.h"
#include "support/RandomScenes.h"

namespace hoctomap {
namespace {

NodeMap mapOf(const PointCloud& hits, double resolution) {
  NodeMap map(resolution, {});
  Beams beams;
  beams.origin = Eigen::Vector3f(2.0F, 0.1F, 0.1F);
  beams.hits = hits;
  map.update(*makeReferenceScanUpdate(), beams);
  return map;
}

Eigen::AlignedBox3d boxOf(const PointCloud& voxels, double resolution) {
  Eigen::AlignedBox3d box;
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(resolution / 2);
  for (const auto& p : voxels) {
    box.extend(Eigen::AlignedBox3d(p.cast<double>() - half, p.cast<double>() + half));
  }
  return box;
}

TEST(NodeMap, RefusesResolutionsThatAreNone) {
  for (const double bad :
       {0.0, -0.1, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(NodeMap(bad, {}), std::invalid_argument);
  }
}

TEST(NodeMap, TheModelOfItsLabelReachesTheTree) {
  OccupancyModel model;
  model.prob_hit = 0.8;
  model.prob_miss = 0.3;
  model.clamping_min = 0.2;
  model.clamping_max = 0.9;
  model.occupancy_threshold = 0.6;
  const NodeMap map(0.1, model);
  EXPECT_NEAR(map.tree().getProbHit(), 0.8, 1e-6);
  EXPECT_NEAR(map.tree().getProbMiss(), 0.3, 1e-6);
  EXPECT_NEAR(map.tree().getClampingThresMin(), 0.2, 1e-6);
  EXPECT_NEAR(map.tree().getClampingThresMax(), 0.9, 1e-6);
  EXPECT_NEAR(map.tree().getOccupancyThres(), 0.6, 1e-6);
}

TEST(NodeMap, BoxesAndRegionsAreThoseOfAllVoxels) {
  test::Rng rng(3);
  NodeMap map(0.02, {});
  for (int scan = 0; scan < 6; ++scan) {  // boxes grow, and shrink where beams clear
    Beams beams;
    beams.origin = test::uniformVector(rng, -2.0, 2.0).cast<float>();
    const PointCloud hits = test::boxSurface(rng, test::randomBox(rng, 1.0), 1500);
    beams.hits = hits;
    map.update(*makeReferenceScanUpdate(), beams);
    const PointCloud all = map.occupiedVoxels();
    EXPECT_TRUE(map.occupiedBox().isApprox(boxOf(all, 0.02), 1e-6)) << scan;
    const Eigen::AlignedBox3d region = test::randomBox(rng, 1.0).box;
    const PointCloud inside = map.occupiedVoxelsIn(region);
    const auto isInside = [&](const Eigen::Vector3f& p) { return region.contains(p.cast<double>()); };
    const auto least = std::count_if(all.begin(), all.end(), isInside);
    EXPECT_EQ(std::count_if(inside.begin(), inside.end(), isInside), least);
    std::size_t found = 0;  // besides, only what shares a pruned cube with the region, in the same order
    for (const auto& p : all) found += found < inside.size() && p == inside[found];
    EXPECT_EQ(found, inside.size());
  }
}

TEST(NodeMap, ItsBoxFollowsWhateverChanges) {
  const double resolution = 0.05;
  test::Rng rng(17);
  NodeMap map(resolution, {});
  NodeMap other(resolution, {});
  const auto scan = [&](NodeMap& to) {
    Beams beams;
    beams.origin = test::uniformVector(rng, -2.0, 2.0).cast<float>();
    const PointCloud hits = test::boxSurface(rng, test::randomBox(rng, 1.0), 60);
    const PointCloud ends = test::boxSurface(rng, test::randomBox(rng, 1.5), 3);
    const PointCloud passing = test::boxSurface(rng, test::randomBox(rng, 2.5), 3000);
    beams.hits = hits;
    beams.endpoints = ends;
    beams.passing = passing;
    if (test::uniform(rng, 0.0, 1.0) < 0.3) beams.max_range = 1.5;
    to.update(*makeReferenceScanUpdate(), beams);
  };
  const auto someVoxels = [&](const NodeMap& of) {
    PointCloud some;
    for (const auto& p : of.occupiedVoxels()) {
      if (p[0] > 0.8F) some.push_back(p);
    }
    return some;
  };
  int shrunk = 0;
  for (int step = 0; step < 200; ++step) {
    const Eigen::AlignedBox3d before = map.occupiedBox();
    switch (std::uniform_int_distribution(0, 7)(rng)) {
      case 0:
        map.cede(someVoxels(map));
        break;
      case 1:
        scan(other);
        break;
      case 2:
        other.give(map, Eigen::Isometry3d::Identity(), [](const auto& p) { return p[1] > 0.7F; });
        break;
      case 3:
        map.give(other, Eigen::Isometry3d::Identity(), [](const auto& p) { return p[1] < -0.7F; });
        break;
      case 4:
        map.add(other, Eigen::Isometry3d::Identity());
        break;
      case 5:
        scan(map);
        [[fallthrough]];  // the box is asked for after two
      default:
        scan(map);
    }
    shrunk += map.occupiedBox().isEmpty() || !map.occupiedBox().contains(before);
    for (const NodeMap* m : {&map, &other}) {
      const Eigen::AlignedBox3d all = boxOf(m->occupiedVoxels(), resolution);
      ASSERT_EQ(m->occupiedBox().isEmpty(), all.isEmpty()) << step;
      if (all.isEmpty()) continue;
      ASSERT_TRUE(m->occupiedBox().isApprox(all, 1e-6)) << step;
    }
  }
  EXPECT_GT(shrunk, 10);
}

TEST(NodeMap, CountsAndListsVoxelsAtItsResolution) {
  test::Rng rng(1);
  // A solid block makes pruned occupied leaves; the counts must not depend on pruning.
  PointCloud block;
  for (int x = 0; x < 8; ++x) {
    for (int y = 0; y < 8; ++y) {
      for (int z = 0; z < 8; ++z)
        block.emplace_back(0.1F * (0.5F + float(x)), 0.1F * (0.5F + float(y)), 0.1F * (0.5F + float(z)));
    }
  }
  const NodeMap map = mapOf(block, 0.1);
  octomap::OcTree expanded(map.tree());
  EXPECT_LT(map.tree().getNumLeafNodes(), 512U);
  expanded.expand();
  VoxelCounts counted;
  for (auto leaf = expanded.begin_leafs(); leaf != expanded.end_leafs(); ++leaf) {
    (expanded.isNodeOccupied(*leaf) ? counted.occupied : counted.free) += 1;
  }
  EXPECT_EQ(counted.occupied, 512U);
  EXPECT_EQ(map.countVoxels().occupied, counted.occupied);
  EXPECT_EQ(map.countVoxels().free, counted.free);
  ASSERT_EQ(map.occupiedVoxels().size(), 512U);
  for (const auto& voxel : map.occupiedVoxels()) {
    const auto* node = expanded.search(voxel.x(), voxel.y(), voxel.z());
    ASSERT_NE(node, nullptr);
    EXPECT_TRUE(expanded.isNodeOccupied(node));
  }
  EXPECT_TRUE(map.occupiedBox().min().isApprox(Eigen::Vector3d::Zero(), 1e-9) ||
              map.occupiedBox().min().norm() < 1e-9);
  EXPECT_TRUE(map.occupiedBox().max().isApprox(Eigen::Vector3d::Constant(0.8), 1e-6));
}

TEST(NodeMap, AbsorbAddsWhatIsOccupiedAndTakesWhatIsUnknown) {
  NodeMap map = mapOf({{0.05F, 0.05F, 0.05F}}, 0.1);
  const NodeMap other = mapOf({{0.05F, 0.05F, 0.05F}, {0.05F, 0.95F, 0.05F}}, 0.1);
  const auto at = [&map](double x, double y, double z) { return map.tree().search(x, y, z); };
  const float hit = map.tree().getProbHitLog();
  ASSERT_EQ(at(0.05, 0.95, 0.05), nullptr);
  const octomap::OcTree before(map.tree());
  map.absorb(other, Eigen::Isometry3d::Identity());
  EXPECT_FLOAT_EQ(at(0.05, 0.05, 0.05)->getLogOdds(), 2 * hit) << "both know it occupied";
  EXPECT_FLOAT_EQ(at(0.05, 0.95, 0.05)->getLogOdds(), hit) << "only the other knows it";
  for (auto leaf = before.begin_leafs(); leaf != before.end_leafs(); ++leaf) {
    if (before.isNodeOccupied(*leaf)) continue;
    EXPECT_FLOAT_EQ(at(leaf.getX(), leaf.getY(), leaf.getZ())->getLogOdds(), leaf->getLogOdds())
        << "free voxels that this map knows stay as they are";
  }
  EXPECT_NEAR(map.occupiedBox().max().y(), 1.0, 1e-6);

  // A turned source lands where it is, not where its numbers are.
  NodeMap turned(0.1, {});
  turned.absorb(other, Eigen::Translation3d(0, 0, 1) *
                           Eigen::Isometry3d(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ())));
  ASSERT_NE(turned.tree().search(-0.05, -0.95, 1.05), nullptr);
  EXPECT_TRUE(turned.tree().isNodeOccupied(turned.tree().search(-0.05, -0.95, 1.05)));
}

TEST(NodeMap, GiveHandsOverWhatIsOccupiedAndKeepsTheRest) {
  NodeMap map = mapOf({{0.05F, 0.05F, 0.05F}, {0.05F, 0.95F, 0.05F}}, 0.1);
  const VoxelCounts before = map.countVoxels();
  const float hit = map.tree().getProbHitLog();
  NodeMap other(0.1, {});
  map.give(other, Eigen::Isometry3d::Identity(), [](const Eigen::Vector3f& p) { return p.y() > 0.5F; });
  EXPECT_EQ(map.countVoxels().free, before.free);
  EXPECT_EQ(map.countVoxels().occupied + other.countVoxels().occupied, before.occupied);
  EXPECT_EQ(map.tree().search(0.05, 0.95, 0.05), nullptr) << "unknown again";
  ASSERT_NE(other.tree().search(0.05, 0.95, 0.05), nullptr);
  EXPECT_FLOAT_EQ(other.tree().search(0.05, 0.95, 0.05)->getLogOdds(), hit);
  EXPECT_EQ(other.countVoxels().free, 0U);
  EXPECT_LT(map.occupiedBox().max().y(), 0.5);
}

TEST(NodeMap, GiveLeavesTheTreeThatStockOctomapWouldMakeOfTheRest) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> coordinate(-0.4F, 0.4F);
  for (int round = 0; round < 8; ++round) {
    PointCloud points;
    for (int i = 0; i < 400; ++i)
      points.emplace_back(coordinate(random), coordinate(random), coordinate(random));
    for (float x = 0.01F; x < 0.32F; x += 0.02F) {  // whole cubes, which are pruned once they are saturated
      for (float y = 0.01F; y < 0.32F; y += 0.02F) {
        for (float z = 0.01F; z < 0.32F; z += 0.02F) points.emplace_back(x, y, z);
      }
    }
    NodeMap map = mapOf(points, 0.02);
    octomap::OcTree expanded(map.tree());
    for (int i = 0; i < 6; ++i) {
      for (const auto& p : points) expanded.updateNode(p.x(), p.y(), p.z(), true);
    }
    expanded.prune();
    map = NodeMap(std::make_unique<octomap::OcTree>(expanded), {});
    const float limit = round == 0 ? -1.0F : coordinate(random);  // the first gives all
    const auto which = [limit](const Eigen::Vector3f& p) { return p.x() + 0.5F * p.y() > limit; };

    octomap::OcTree rest(0.02);
    std::size_t given = 0;
    expanded.expand();
    for (auto leaf = expanded.begin_leafs(); leaf != expanded.end_leafs(); ++leaf) {
      const Eigen::Vector3f p = Eigen::Vector3d(leaf.getX(), leaf.getY(), leaf.getZ()).cast<float>();
      if (expanded.isNodeOccupied(*leaf) && which(p)) {
        ++given;
      } else {
        rest.setNodeValue(leaf.getKey(), leaf->getLogOdds(), true);
      }
    }
    rest.updateInnerOccupancy();
    rest.prune();
    NodeMap other(0.02, {});
    map.give(other, Eigen::Isometry3d::Identity(), which);
    EXPECT_EQ(other.countVoxels().occupied, given);
    EXPECT_EQ(map.tree().size(), rest.size());
    EXPECT_EQ(test::otBytes(map.tree()), test::otBytes(rest));
  }
}

TEST(NodeMap, CedesWhatOthersShowAsOftenAsItWasHitThere) {
  const PointCloud own{{0.05F, 0.05F, 0.05F}, {0.05F, 0.95F, 0.05F}};
  NodeMap map = mapOf(own, 0.1);
  Beams again;
  again.origin = Eigen::Vector3f(2.0F, 0.1F, 0.1F);
  again.hits = own;
  map.update(*makeReferenceScanUpdate(), again);
  const VoxelCounts before = map.countVoxels();
  const auto at = [&](float y) { return map.tree().search(0.05, static_cast<double>(y), 0.05); };
  const float of_two_hits = at(0.05F)->getLogOdds();

  map.cede({{0.05F, 0.15F, 0.05F}, {0.06F, 0.14F, 0.05F}});  // beside the first voxel: once a scan
  ASSERT_NE(at(0.05F), nullptr);
  EXPECT_FLOAT_EQ(at(0.05F)->getLogOdds(), of_two_hits - map.tree().getProbHitLog());
  EXPECT_FLOAT_EQ(at(0.95F)->getLogOdds(), of_two_hits);

  map.cede({{0.05F, 0.05F, 0.05F}});
  map.cede({{0.05F, 0.05F, 0.05F}});
  EXPECT_EQ(at(0.05F), nullptr) << "unknown";
  EXPECT_EQ(map.countVoxels().occupied, before.occupied - 1);
  EXPECT_EQ(map.countVoxels().free, before.free) << "what beams have shown to be free stays";
  EXPECT_GT(map.occupiedBox().min().y(), 0.8);
}

TEST(NodeMap, TheBoxForgetsAnOutlierThatIsCleared) {
  NodeMap map = mapOf({{0.05F, 0.05F, 0.05F}, {1.05F, 0.05F, 0.05F}}, 0.1);
  const auto engine = makeReferenceScanUpdate();
  EXPECT_NEAR(map.occupiedBox().max().x(), 1.1, 1e-6);
  const PointCloud hit{{0.05F, 0.05F, 0.05F}};
  Beams beams;
  beams.origin = Eigen::Vector3f(2.0F, 0.05F, 0.05F);
  beams.hits = hit;
  for (int i = 0; i < 10; ++i) map.update(*engine, beams);
  EXPECT_NEAR(map.occupiedBox().max().x(), 0.1, 1e-6);
  EXPECT_TRUE(NodeMap(0.1, {}).occupiedBox().isEmpty());
}

}  // namespace
}  // namespace hoctomap
