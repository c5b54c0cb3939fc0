// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "BoxScene.h"
#include "hoctomap/tabletop/Tabletop.h"

namespace hoctomap {
namespace {

using test::filledMap;

constexpr double kMargin = 0.02;

class TabletopAssociation : public ::testing::Test {
 protected:
  static Eigen::AlignedBox3d cube(double size) {
    return {Eigen::Vector3d::Constant(-size / 2.0), Eigen::Vector3d::Constant(size / 2.0)};
  }

  NodeId add(const Label& label, double x, double size = 0.1, NodeId parent = kRootId) {
    return hierarchy_.add(label, filledMap(0.01, cube(size)), Pose(x, 0, 0, 0, 0, 0), parent);
  }

  std::optional<NodeId> associate(double x, double size = 0.1, const Admissible& admissible = {},
                                  const Label& label = labels::object) {
    const Obb box{Eigen::Isometry3d(Eigen::Translation3d(x, 0, 0)), cube(size)};
    test::Rng rng(7);
    const auto points = test::boxSurface(rng, box, 600);
    return makeTabletopAssociation(kMargin)->associate(hierarchy_, {label, &points, box}, admissible);
  }

  MapHierarchy hierarchy_{labels::background, NodeMap(0.05, OccupancyModel{})};
};

TEST_F(TabletopAssociation, FindsNothingInAnEmptyHierarchy) {
  EXPECT_EQ(associate(0.0), std::nullopt);
}

TEST_F(TabletopAssociation, NeedsTheSameLabel) {
  add(labels::table, 0.0);
  EXPECT_EQ(associate(0.0), std::nullopt);
  const NodeId object = add(labels::object, 0.0);
  EXPECT_EQ(associate(0.0), object);
}

TEST_F(TabletopAssociation, NeedsIntersectingBoxes) {
  const NodeId node = add(labels::object, 0.0);
  EXPECT_EQ(associate(0.05), node);
  EXPECT_EQ(associate(0.5), std::nullopt);
}

TEST_F(TabletopAssociation, LooksAtTheOrientedBox) {
  // A thin plate along the diagonal: its world-aligned box holds the segment, its own does not.
  const Eigen::AlignedBox3d plate(Eigen::Vector3d(-0.3, -0.01, -0.05), Eigen::Vector3d(0.3, 0.01, 0.05));
  const NodeId node =
      hierarchy_.add(labels::object, filledMap(0.01, plate), Pose(0, 0, 0, 0.785398, 0, 0), kRootId);
  EXPECT_EQ(associate(0.2, 0.08), std::nullopt);
  EXPECT_EQ(associate(0.02, 0.08), node);
}

TEST_F(TabletopAssociation, BridgesDriftUpToTheMargin) {
  const NodeId node = add(labels::object, 0.0, 0.04);
  // Two thin plates that face each other over a gap: the two sides of one thing, drifted apart.
  const Eigen::AlignedBox3d plate(Eigen::Vector3d(-0.001, -0.02, -0.02), Eigen::Vector3d(0.001, 0.02, 0.02));
  const auto at = [&](double x) {
    const Obb box{Eigen::Isometry3d(Eigen::Translation3d(x, 0, 0)), plate};
    test::Rng rng(7);
    const auto points = test::boxSurface(rng, box, 600);
    return makeTabletopAssociation(kMargin)->associate(hierarchy_, {labels::object, &points, box}, {});
  };
  EXPECT_EQ(at(0.02 + 0.01 + 0.001 + 0.015), node);
  EXPECT_EQ(at(0.02 + 0.01 + 0.001 + 0.025), std::nullopt);
}

TEST_F(TabletopAssociation, MarginDoesNotSwallowANeighbour) {
  add(labels::object, 0.0);
  // 2.5 cm of air: within the margin and the node's padding, but the far side of the segment is far away.
  EXPECT_EQ(associate(0.05 + 0.025 + 0.15, 0.3), std::nullopt);
}

TEST_F(TabletopAssociation, PrefersTheDeepest) {
  const NodeId shallow = add(labels::object, 0.0);
  const NodeId table = add(labels::table, 0.0);
  const NodeId deep = add(labels::object, 0.08, 0.1, table);
  EXPECT_EQ(associate(0.0), deep);  // though the overlap with the other is larger
  EXPECT_EQ(associate(-0.06), shallow);
}

TEST_F(TabletopAssociation, ThenTheLargestOverlap) {
  const NodeId left = add(labels::object, -0.08);
  const NodeId right = add(labels::object, 0.08);
  EXPECT_EQ(associate(-0.02), left);
  EXPECT_EQ(associate(0.02), right);
}

TEST_F(TabletopAssociation, ThenTheLowestId) {
  const NodeId first = add(labels::object, 0.0);
  add(labels::object, 0.0);
  EXPECT_EQ(associate(0.03), first);
}

TEST_F(TabletopAssociation, SkipsWhatIsNotAdmissible) {
  const NodeId first = add(labels::object, 0.0);
  const NodeId second = add(labels::object, 0.05);
  EXPECT_EQ(associate(0.0, 0.1, [&](NodeId id) { return id != first; }), second);
  EXPECT_EQ(associate(0.0, 0.1, [](NodeId) { return false; }), std::nullopt);
}

}  // namespace
}  // namespace hoctomap
