// SPDX-License-Identifier: BSD-3-Clause
// The fast engine against the simple one and against stock OctoMap: equal bytes after every scan.
#include <gtest/gtest.h>

#include "block_scenes.h"
#include "hoctomap/octree/BlockScanUpdate.h"

namespace hoctomap::test {
namespace {

using octomap::OcTree;

/// Two trees that receive the same scans, one from each implementation.
struct Pair {
  explicit Pair(double resolution, Instructions instructions = Instructions::best)
      : expected(resolution), actual(resolution), fast(makeBlockScanUpdate(instructions)) {}

  std::string update(const Beams& beams) {
    const auto expected_report = simple->apply(expected, beams);
    const auto actual_report = fast->apply(actual, beams);
    if (expected_report.beyond_key_range != actual_report.beyond_key_range) return "the reports differ";
    return difference(expected, actual);
  }

  OcTree expected;
  OcTree actual;
  std::unique_ptr<ScanUpdate> simple = makeReferenceScanUpdate();
  std::unique_ptr<ScanUpdate> fast;
};

octomap::Pointcloud toOctomap(std::span<const Eigen::Vector3f> points) {
  octomap::Pointcloud cloud;
  for (const auto& p : points) cloud.push_back(p.x(), p.y(), p.z());
  return cloud;
}

TEST(BlockScanUpdate, UnboundedScansGiveTheSameBytes) {
  for (int seed = 0; seed < 50 * sweepFactor(); ++seed) {
    SceneMaker scene(static_cast<std::uint64_t>(seed));
    Pair pair(scene.resolution(), instructionsFor(static_cast<std::uint64_t>(seed)));
    for (int scan = 0; scan < 4; ++scan) {
      ASSERT_EQ(pair.update(scene.scan(150, scan % 2 == 0 ? 0 : 50, scan == 3 ? 30 : 0)), "")
          << "seed " << seed << " scan " << scan;
    }
  }
}

TEST(BlockScanUpdate, BoundedScansGiveTheSameBytes) {
  int met = 0;
  for (int seed = 1000; seed < 1000 + 220 * sweepFactor(); ++seed) {
    SceneMaker scene(static_cast<std::uint64_t>(seed));
    Pair pair(scene.resolution(), instructionsFor(static_cast<std::uint64_t>(seed)));
    for (int scan = 0; scan < 4; ++scan) {
      Beams beams = scene.scan(60, 60, scan == 3 ? 20 : 0);
      beams.bounds = scene.box();
      ASSERT_EQ(pair.update(beams), "") << "seed " << seed << " scan " << scan;
    }
    met += pair.actual.size() > 0 ? 1 : 0;
  }
  EXPECT_GT(met, 150);  // most boxes are met by some beam
}

/// More blocks than the first stage of the table holds, and a box that cuts the beams far out.
TEST(BlockScanUpdate, LongBeamsGiveTheSameBytes) {
  for (const bool bounded : {false, true}) {
    Pair pair(0.001);
    const PointCloud ends{
        {14.0F, 3.0F, -2.0F}, {-9.0F, 8.0F, 1.0F}, {13.9F, 3.01F, -2.02F}, {0.5F, -17.0F, 0.25F}};
    Beams beams;
    beams.origin = {0.1234F, -0.2F, 0.3F};
    beams.hits = ends;
    if (bounded) beams.bounds = Eigen::AlignedBox3d(Eigen::Vector3d(6, 0, -2), Eigen::Vector3d(50, 3, 1));
    ASSERT_EQ(pair.update(beams), "");
    EXPECT_GT(pair.actual.size(), 1000U);
  }
}

TEST(BlockScanUpdate, EqualsStockInsertPointCloud) {
  for (int seed = 2000; seed < 2015; ++seed) {
    SceneMaker scene(static_cast<std::uint64_t>(seed));
    OcTree stock(scene.resolution());
    OcTree ours(scene.resolution());
    const auto engine = makeBlockScanUpdate();
    for (int scan = 0; scan < 3; ++scan) {
      const Beams beams = scene.scan(200, 0);
      const auto& o = beams.origin;
      testing::internal::CaptureStderr();  // octomap complains of points beyond the key range
      stock.insertPointCloud(toOctomap(beams.hits), {o.x(), o.y(), o.z()}, beams.max_range);
      testing::internal::GetCapturedStderr();
      engine->apply(ours, beams);
      ASSERT_EQ(difference(stock, ours), "") << "seed " << seed << " scan " << scan;
    }
  }
}

TEST(BlockScanUpdate, SaturatedMapsGiveTheSameBytes) {
  for (int seed = 3000; seed < 3004; ++seed) {
    SceneMaker scene(static_cast<std::uint64_t>(seed));
    Pair pair(scene.resolution());
    Beams beams = scene.scan(150, 20);
    for (int scan = 0; scan < 12; ++scan) {  // long enough for every voxel to reach its limit
      ASSERT_EQ(pair.update(beams), "") << "seed " << seed << " scan " << scan;
    }
    ASSERT_EQ(pair.update(scene.scan(150, 20)), "") << "seed " << seed;
  }
}

/// Dense scans fill and prune whole nodes, and beams from the inside of large pruned leaves expand them
/// again.
TEST(BlockScanUpdate, FilledVolumesGiveTheSameBytes) {
  constexpr double kResolution = 0.02;
  Pair pair(kResolution);
  PointCloud wall;
  for (int y = -60; y < 60; ++y) {
    for (int z = -60; z < 60; ++z)
      wall.emplace_back(1.4F, 0.01F * static_cast<float>(y), 0.01F * static_cast<float>(z));
  }
  const PointCloud few{{0.9F, 0.1F, 0.1F}, {0.5F, -0.2F, 0.05F}, {1.2F, 0.0F, 0.0F}};
  Beams beams;
  beams.origin = {0.005F, 0.005F, 0.005F};
  beams.hits = wall;
  for (int scan = 0; scan < 3; ++scan) ASSERT_EQ(pair.update(beams), "") << scan;
  beams.hits = few;
  ASSERT_EQ(pair.update(beams), "");
  beams.hits = {};
  beams.passing = few;
  beams.bounds = Eigen::AlignedBox3d(Eigen::Vector3d(0.2, -0.1, -0.1), Eigen::Vector3d(0.8, 0.3, 0.3));
  ASSERT_EQ(pair.update(beams), "");
}

TEST(BlockScanUpdate, SolidVolumesOfHitsGiveTheSameBytes) {
  Pair pair(0.02);
  PointCloud solid;
  for (int i = 0; i < 66 * 66 * 66; ++i) {
    solid.emplace_back(0.01F + 0.02F * static_cast<float>(i % 66),
                       0.01F + 0.02F * static_cast<float>(i / 66 % 66),
                       0.01F + 0.02F * static_cast<float>(i / 4356));
  }
  Beams beams;
  beams.origin = {0.61F, 0.61F, 0.61F};
  beams.hits = solid;
  ASSERT_EQ(pair.update(beams), "");
  EXPECT_LT(pair.actual.getNumLeafNodes(), solid.size() / 2);  // a whole block is one leaf now
  beams.hits = beams.hits.first(1000);
  beams.passing = beams.hits.last(300);
  ASSERT_EQ(pair.update(beams), "");
}

TEST(BlockScanUpdate, OtherSensorModelsGiveTheSameBytes) {
  int model = 0;
  for (const auto& [hit, miss, low, high] : std::vector<std::array<double, 4>>{
           {0.6, 0.5, 0.1, 0.9}, {0.5, 0.3, 0.2, 0.8}, {0.9, 0.1, 0.3, 0.7}, {0.7, 0.45, 0.4999, 0.97}}) {
    SceneMaker scene(static_cast<std::uint64_t>(4000 + model));
    Pair pair(scene.resolution());
    for (OcTree* tree : {&pair.expected, &pair.actual}) {
      tree->setProbHit(hit);
      tree->setProbMiss(miss);
      tree->setClampingThresMin(low);
      tree->setClampingThresMax(high);
    }
    for (int scan = 0; scan < 5; ++scan) ASSERT_EQ(pair.update(scene.scan(150, 50)), "") << "model " << model;
    ++model;
  }
}

/// Stock OctoMap goes on working on our tree, and we on its trees, pruned or not.
TEST(BlockScanUpdate, TakesTurnsWithStockOctomap) {
  for (int seed = 5000; seed < 5009; ++seed) {
    SceneMaker scene(static_cast<std::uint64_t>(seed));
    Pair pair(scene.resolution());
    for (int turn = 0; turn < 3; ++turn) {
      ASSERT_EQ(pair.update(scene.scan(100, 0)), "") << "seed " << seed;
      const Beams beams = scene.scan(100, 0);
      for (OcTree* tree : {&pair.expected, &pair.actual}) {
        for (const auto& p : beams.hits) {
          octomap::OcTreeKey key;
          if (!tree->coordToKeyChecked(p.x(), p.y(), p.z(), key)) continue;
          if (turn == 0) tree->updateNode(key, true);
          if (turn == 1) tree->updateNode(key, true, true);  // lazily: inner nodes are stale now
        }
        if (turn == 1 && seed % 3 == 1) tree->prune();
        if (turn == 2 && tree->size() < 2000) tree->expand();
      }
      ASSERT_EQ(pair.update(beams), "") << "seed " << seed << " turn " << turn;
    }
    pair.actual.clear();
    EXPECT_EQ(pair.actual.size(), 0U);
  }
}

TEST(BlockScanUpdate, KeepsTheRecordOfChanges) {
  SceneMaker scene(6000);
  Pair pair(scene.resolution());
  pair.expected.enableChangeDetection(true);
  pair.actual.enableChangeDetection(true);
  ASSERT_EQ(pair.update(scene.scan(100, 0)), "");
  EXPECT_GT(pair.actual.numChangesDetected(), 0U);
  EXPECT_EQ(pair.actual.numChangesDetected(), pair.expected.numChangesDetected());
}

TEST(BlockScanUpdate, NothingToUpdateLeavesTheTreeEmpty) {
  OcTree tree(0.1);
  const auto engine = makeBlockScanUpdate();
  Beams beams;
  engine->apply(tree, beams);
  EXPECT_EQ(tree.size(), 0U);
  const PointCloud here{Eigen::Vector3f::Zero()};
  beams.passing = here;  // ends in the voxel of the origin: no free cell
  engine->apply(tree, beams);
  EXPECT_EQ(tree.size(), 0U);
}

/// Metric size is cached by octomap until told that the tree changed.
TEST(BlockScanUpdate, MetricSizeFollows) {
  OcTree tree(0.1);
  const auto engine = makeBlockScanUpdate();
  PointCloud end{{1.05F, 0.05F, 0.05F}};
  Beams beams;
  beams.origin = {0.05F, 0.05F, 0.05F};
  beams.hits = end;
  double x = 0;
  double y = 0;
  double z = 0;
  engine->apply(tree, beams);
  tree.getMetricMax(x, y, z);
  EXPECT_NEAR(x, 1.1, 1e-9);
  end[0].x() = 2.05F;
  engine->apply(tree, beams);
  tree.getMetricMax(x, y, z);
  EXPECT_NEAR(x, 2.1, 1e-9);
}

}  // namespace
}  // namespace hoctomap::test
