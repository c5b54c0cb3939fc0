// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <set>

#include "BoxScene.h"
#include "TableChoice.h"
#include "hoctomap/hierarchy/MapHierarchy.h"
#include "hoctomap/tabletop/Tabletop.h"
#include "support/RandomScenes.h"

namespace hoctomap {
namespace {

using test::filledMap;

TEST(TabletopLabeling, FollowsTheStructure) {  // Eq. (10)
  const auto labeling = makeTabletopLabeling();
  const Measurement z;
  EXPECT_EQ(labeling->label(z, {Structure::plane, {}, {}}), labels::table);
  EXPECT_EQ(labeling->label(z, {Structure::cluster, {}, {}}), labels::object);
  EXPECT_EQ(labeling->label(z, {Structure::remainder, {}, {}}), labels::background);
}

TEST(TabletopRelation, IsThatOfEquation11) {
  const auto relation = makeTabletopRelation();
  const std::vector<Label> all{labels::background, labels::table, labels::object, Label{"mug"}};
  for (const auto& i : all) {
    for (const auto& j : all) {
      const bool expected = (i == labels::table && j == labels::object) ||
                            (i == labels::background && j == labels::table) ||
                            (i == labels::background && j == labels::object);
      EXPECT_EQ(relation->holds({i, {}, nullptr}, {j, {}, nullptr}), expected) << i.name << " " << j.name;
    }
  }
}

/// A hierarchy with tables, and the parent of an object in it.
class TableChoice : public ::testing::Test {
 protected:
  NodeId addTable(double x_min, double x_max, double height, double yaw = 0.0) {
    const Eigen::Vector3d half((x_max - x_min) / 2.0, 0.4, 0.01);
    const Pose world_T_node((x_min + x_max) / 2.0, 0.0, height, yaw, 0.0, 0.0);
    return hierarchy_.add(labels::table, filledMap(0.02, {-half, half}), world_T_node, kRootId);
  }

  NodeId parentOf(double x, double y, double bottom, double size = 0.1) {
    const Eigen::Vector3d center(x, y, bottom + size / 2.0);
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(size / 2.0);
    const Obb box{Eigen::Isometry3d(Eigen::Translation3d(center)), {-half, half}};
    return makeTabletopRelations().deepestAncestor(hierarchy_, {labels::object, box, nullptr});
  }

  MapHierarchy hierarchy_{labels::background, NodeMap(0.05, OccupancyModel{})};
};

TEST_F(TableChoice, WithoutTablesIsTheBackground) {
  EXPECT_EQ(parentOf(0.0, 0.0, 0.75), kRootId);
}

TEST_F(TableChoice, IsTheTableUnderTheObject) {
  const NodeId left = addTable(-1.5, -0.5, 0.75);
  const NodeId right = addTable(0.5, 1.5, 0.75);
  EXPECT_EQ(parentOf(-1.0, 0.1, 0.76), left);
  EXPECT_EQ(parentOf(1.0, 0.1, 0.76), right);
  EXPECT_EQ(parentOf(1.45, 0.39, 0.76), right);
}

TEST_F(TableChoice, WorksInTheFrameOfTheNode) {
  const NodeId turned = addTable(-1.2, -0.2, 0.75, 1.0);  // its centre is at -0.7
  const NodeId other = addTable(0.2, 1.2, 0.75, -2.0);
  EXPECT_EQ(parentOf(-0.6, 0.0, 0.76), turned);
  EXPECT_EQ(parentOf(0.6, 0.0, 0.76), other);
}

TEST_F(TableChoice, IsTheNearestSurfaceBelow) {
  const NodeId low = addTable(-0.5, 0.5, 0.55);
  const NodeId high = addTable(-0.5, 0.5, 0.95);
  EXPECT_EQ(parentOf(0.0, 0.0, 0.96), high);
  EXPECT_EQ(parentOf(0.0, 0.0, 0.56), low);  // the other surface is nearer than 0.5 m, but above
}

TEST_F(TableChoice, FindsTheTableThroughTheHoleUnderTheObject) {
  auto tree = std::make_unique<octomap::OcTree>(0.02);
  for (double x = -0.39; x < 0.4; x += 0.02) {
    for (double y = -0.39; y < 0.4; y += 0.02) {
      if (std::max(std::abs(x), std::abs(y)) > 0.08) tree->updateNode(x, y, 0.01, true);
    }
  }
  const NodeId beside = addTable(0.5, 1.5, 0.75);
  const NodeId holed = hierarchy_.add(labels::table, NodeMap(std::move(tree), OccupancyModel{}),
                                      Pose(0.0, 0.0, 0.74, 0.0, 0.0, 0.0), kRootId);
  EXPECT_EQ(parentOf(0.0, 0.0, 0.76, 0.16), holed);
  EXPECT_EQ(parentOf(1.0, 0.0, 0.76, 0.16), beside);
}

TEST_F(TableChoice, OfEqualsIsTheLowestId) {
  const NodeId first = addTable(-0.5, 0.5, 0.75);
  addTable(-0.5, 0.5, 0.75);
  EXPECT_EQ(parentOf(0.0, 0.0, 0.76), first);
}

TEST_F(TableChoice, TableWithoutSurfaceIsTheLastChoice) {
  hierarchy_.add(labels::table, NodeMap(0.02, OccupancyModel{}), Pose(), kRootId);
  const NodeId real = addTable(-0.5, 0.5, 0.75);
  EXPECT_EQ(parentOf(0.0, 0.0, 0.76), real);
}

TEST_F(TableChoice, TablesElsewhereDoNotMatter) {
  test::Rng rng(5);
  for (int trial = 0; trial < 10; ++trial) {
    hierarchy_ = MapHierarchy(labels::background, NodeMap(0.05, OccupancyModel{}));
    NodeId own;
    const int before = static_cast<int>(rng() % 6);
    for (int i = 0; i < 8; ++i) {
      if (i == before) own = addTable(-0.5, 0.5, 0.75);
      const double x = test::uniform(rng, 1.4, 6.0) * (rng() % 2 != 0 ? 1.0 : -1.0);
      addTable(x - 0.4, x + 0.4, test::uniform(rng, 0.6, 0.9), test::uniform(rng, 0.0, 3.0));
    }
    EXPECT_EQ(parentOf(test::uniform(rng, -0.3, 0.3), test::uniform(rng, -0.3, 0.3), 0.76), own);
  }
}

TEST_F(TableChoice, FarFromAllIsTheNearestTable) {
  const NodeId near = addTable(2.0, 3.0, 0.75);
  const NodeId far = addTable(20.0, 21.0, 0.75);
  EXPECT_EQ(parentOf(0.0, 0.0, 0.76), near);
  EXPECT_EQ(parentOf(15.0, 0.0, 0.76), far);
}

/// Tables of several sizes and heights, some without voxels, some that wait; some stand on others.
void addTables(MapHierarchy& h, test::Rng& rng, bool on_tables) {
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector3d half(test::uniform(rng, 0.1, 0.5), test::uniform(rng, 0.1, 0.5), 0.03);
    const Pose at(test::uniform(rng, -4.0, 4.0), test::uniform(rng, -4.0, 4.0), 0.2 * double(rng() % 4),
                  test::uniform(rng, -3.0, 3.0), 0.0, 0.0);
    NodeMap map = rng() % 8 == 0 ? NodeMap(0.05, {}) : filledMap(0.05, {-half, half});
    const auto ids = h.ids();
    const NodeId parent = on_tables && rng() % 4 == 0 ? ids[rng() % ids.size()] : kRootId;
    const NodeId id = h.add(labels::table, std::move(map), at, parent);
    if (rng() % 8 == 0) h.node(id).confirmation.waits = true;
    h.add(labels::object, filledMap(0.05, {-half / 4.0, half / 4.0}), at, id);
  }
}

TEST(TabletopRelation, FindsTheParentThatALookAtEveryNodeFinds) {
  RelationSet all;  // the same choice, without its reach
  all.add(makeTabletopRelation());
  all.setTieBreak(preferredTable);
  const RelationSet relations = makeTabletopRelations();
  std::set<NodeId> chosen;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    test::Rng rng(seed);
    MapHierarchy h(labels::background, NodeMap(0.05, OccupancyModel{}));
    addTables(h, rng, seed % 2 == 0);
    for (int i = 0; i < 40; ++i) {
      const Eigen::Vector3d half = Eigen::Vector3d::Constant(test::uniform(rng, 0.02, 0.1));
      const Eigen::Isometry3d at(Eigen::Translation3d(test::uniformVector(rng, -4.5, 4.5)));
      const NodeView below{labels::object, {at, {-half, half}}, nullptr};
      const NodeId except = h.ids()[rng() % h.size()];
      const NodeId* const not_this = rng() % 3 == 0 && except != kRootId ? &except : nullptr;
      const NodeId found = relations.deepestAncestor(h, below, not_this);
      EXPECT_EQ(found, all.deepestAncestor(h, below, not_this)) << seed << ", " << i;
      chosen.insert(found);
    }
  }
  EXPECT_GT(chosen.size(), 20U);
}

}  // namespace
}  // namespace hoctomap
