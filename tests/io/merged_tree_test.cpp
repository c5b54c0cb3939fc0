// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/MergedTree.h"

#include <gtest/gtest.h>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/hierarchy/LogOdds.h"
#include "random_map.h"

namespace hoctomap {
namespace {

/// A map whose voxels in `box` all have this probability.
NodeMap filled(double resolution, const Eigen::AlignedBox3d& box, double probability) {
  auto tree = std::make_unique<octomap::OcTree>(resolution);
  const double half = 0.5 * resolution;
  for (double x = box.min().x() + half; x < box.max().x(); x += resolution) {
    for (double y = box.min().y() + half; y < box.max().y(); y += resolution) {
      for (double z = box.min().z() + half; z < box.max().z(); z += resolution)
        tree->setNodeValue(x, y, z, static_cast<float>(logOdds(probability)), true);
    }
  }
  tree->updateInnerOccupancy();
  tree->prune();
  return {std::move(tree), OccupancyModel{}};
}

double at(const octomap::OcTree& tree, double x, double y, double z) {
  const auto* leaf = tree.search(x, y, z);
  return leaf == nullptr ? -1.0 : leaf->getOccupancy();
}

Eigen::AlignedBox3d box(double x0, double y0, double z0, double x1, double y1, double z1) {
  return {Eigen::Vector3d(x0, y0, z0), Eigen::Vector3d(x1, y1, z1)};
}

constexpr double kSure = 50.0;  // log-odds of an existence of 1

TEST(MergedTree, OfOneNodeIsTheNode) {
  test::Rng rng(3);
  MapHierarchy hierarchy(labels::background, test::randomNodeMap(rng, 0.05));
  hierarchy.root().existence_log_odds = kSure;
  const octomap::OcTree& tree = hierarchy.root().map().tree();
  const auto merged = mergedTree(hierarchy, 0.05);
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf)
    EXPECT_NEAR(at(*merged, leaf.getX(), leaf.getY(), leaf.getZ()), leaf->getOccupancy(), 1e-6);
  std::size_t known = 0;
  for (auto leaf = merged->begin_leafs(); leaf != merged->end_leafs(); ++leaf) {
    ASSERT_NE(tree.search(leaf.getX(), leaf.getY(), leaf.getZ()), nullptr) << "nothing is made up";
    ++known;
  }
  EXPECT_GT(known, 10U);
}

TEST(MergedTree, TheFinerNodeDecidesAsFarAsItExists) {
  // A coarse block, and a fine one that knows its middle to be free.
  MapHierarchy hierarchy(labels::background, filled(0.08, box(-0.16, -0.16, -0.16, 0.16, 0.16, 0.16), 0.9));
  hierarchy.root().existence_log_odds = kSure;
  const NodeId fine = hierarchy.add(
      labels::object, filled(0.01, box(-0.04, -0.04, -0.04, 0.04, 0.04, 0.04), 0.2), Pose(), kRootId);
  hierarchy.node(fine).existence_log_odds = logOdds(0.75);
  const auto merged = mergedTree(hierarchy, 0.01);
  EXPECT_NEAR(at(*merged, 0.005, 0.005, 0.005), 0.5 + 0.75 * (0.2 - 0.5), 1e-5);
  EXPECT_NEAR(at(*merged, 0.105, 0.005, 0.005), 0.9, 1e-5);
  EXPECT_EQ(at(*merged, 0.205, 0.005, 0.005), -1.0) << "unknown stays unknown";
}

TEST(MergedTree, ADoubtfulNodeDrawsItsVoxelsToOneHalf) {
  MapHierarchy hierarchy(labels::background, NodeMap(0.05, {}));
  const NodeId id =
      hierarchy.add(labels::object, filled(0.01, box(0, 0, 0, 0.03, 0.03, 0.03), 0.9), Pose(), kRootId);
  hierarchy.node(id).existence_log_odds = logOdds(0.6);
  const auto merged = mergedTree(hierarchy, 0.01);
  EXPECT_NEAR(at(*merged, 0.015, 0.015, 0.015), 0.6 * 0.9 + 0.4 * 0.5, 1e-5);
}

TEST(MergedTree, OfEquallyFineNodesTheOneThatSeesSomethingDecides) {
  MapHierarchy hierarchy(labels::background, NodeMap(0.05, {}));
  for (const double probability : {0.2, 0.9, 0.3}) {
    const NodeId id = hierarchy.add(labels::object, filled(0.01, box(0, 0, 0, 0.02, 0.02, 0.02), probability),
                                    Pose(), kRootId);
    hierarchy.node(id).existence_log_odds = kSure;
  }
  EXPECT_NEAR(at(*mergedTree(hierarchy, 0.01), 0.005, 0.005, 0.005), 0.9, 1e-5);
}

TEST(MergedTree, CoarserVoxelsAreOccupiedIfAnythingInThemIs) {
  MapHierarchy hierarchy(labels::background, filled(0.01, box(0, 0, 0, 0.08, 0.08, 0.08), 0.2));
  hierarchy.root().existence_log_odds = kSure;
  const NodeId id =
      hierarchy.add(labels::object, filled(0.005, box(0, 0, 0, 0.005, 0.005, 0.005), 0.9), Pose(), kRootId);
  hierarchy.node(id).existence_log_odds = kSure;
  const auto merged = mergedTree(hierarchy, 0.04);
  EXPECT_NEAR(at(*merged, 0.02, 0.02, 0.02), 0.9, 1e-5);
  EXPECT_NEAR(at(*merged, 0.06, 0.02, 0.02), 0.2, 1e-5);
}

TEST(MergedTree, TurnedNodesLeaveNoHoles) {
  test::Rng rng(8);
  for (const double resolution : {0.004, 0.01, 0.023}) {
    MapHierarchy hierarchy(labels::background, NodeMap(0.05, {}));
    const Pose world_T_node = test::randomPose(rng, 1.0);
    const Eigen::AlignedBox3d block = box(0, 0, 0, 0.12, 0.09, 0.06);
    const NodeId id = hierarchy.add(labels::object, filled(0.01, block, 0.9), world_T_node, kRootId);
    hierarchy.node(id).existence_log_odds = kSure;
    const auto merged = mergedTree(hierarchy, resolution);
    for (int probe = 0; probe < 2000; ++probe) {
      const Eigen::Vector3d node_point(test::uniform(rng, resolution, 0.12 - resolution),
                                       test::uniform(rng, resolution, 0.09 - resolution),
                                       test::uniform(rng, resolution, 0.06 - resolution));
      const Eigen::Vector3d p = toIsometry(world_T_node) * node_point;
      ASSERT_GT(at(*merged, p.x(), p.y(), p.z()), 0.8) << resolution;
    }
    // Nor does it grow by more than a voxel.
    for (auto leaf = merged->begin_leafs(); leaf != merged->end_leafs(); ++leaf) {
      const Eigen::Vector3d p =
          toIsometry(world_T_node).inverse() * Eigen::Vector3d(leaf.getX(), leaf.getY(), leaf.getZ());
      EXPECT_LE(block.exteriorDistance(p), std::sqrt(3.0) * leaf.getSize());
    }
  }
}

TEST(MergedTree, RefusesWhatItCannotDo) {
  MapHierarchy hierarchy(labels::background, filled(0.08, box(0, 0, 0, 0.8, 0.8, 0.8), 0.9));
  EXPECT_THROW((void)mergedTree(hierarchy, 0.0), ConfigError);
  EXPECT_THROW((void)mergedTree(hierarchy, std::nan("")), ConfigError);
  EXPECT_THROW((void)mergedTree(hierarchy, 0.0005), LimitError);
}

}  // namespace
}  // namespace hoctomap
