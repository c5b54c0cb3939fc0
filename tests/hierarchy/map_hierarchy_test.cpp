// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/hierarchy/MapHierarchy.h"

#include <gtest/gtest.h>

#include <set>

#include "support/RandomScenes.h"

namespace hoctomap {
namespace {

NodeMap anyMap() {
  return NodeMap(0.05, {});
}

MapHierarchy emptyHierarchy() {
  return MapHierarchy(labels::background, anyMap());
}

double difference(const Pose& a, const Pose& b) {
  return (toIsometry(a).matrix() - toIsometry(b).matrix()).cwiseAbs().maxCoeff();
}

/// A hierarchy of `count` further nodes under random parents, and the world pose of each.
std::map<NodeId, Pose> grow(MapHierarchy& h, test::Rng& rng, int count) {
  std::map<NodeId, Pose> world;
  for (int i = 0; i < count; ++i) {
    const auto ids = h.ids();
    const Pose pose = test::randomPose(rng, 3.0);
    world[h.add(labels::object, anyMap(), pose, ids[rng() % ids.size()])] = pose;
  }
  return world;
}

/// One root, parents exist, `children` mirrors `parent`, no cycles.
void expectConsistent(const MapHierarchy& h) {
  std::set<NodeId> seen;
  for (const NodeId id : h.preorder()) {
    EXPECT_TRUE(seen.insert(id).second) << "visited twice";
    const MapNode& n = h.node(id);
    EXPECT_EQ(n.parent().has_value(), id != kRootId);
    if (n.parent()) {
      EXPECT_TRUE(seen.contains(*n.parent())) << "parents before children";
      const auto& siblings = h.node(*n.parent()).children();
      EXPECT_EQ(std::count(siblings.begin(), siblings.end(), id), 1);
    }
    EXPECT_TRUE(std::is_sorted(n.children().begin(), n.children().end()));
  }
  EXPECT_EQ(seen.size(), h.size());
}

TEST(MapHierarchy, GlobalPoseIsTheCompositionFromTheRoot) {  // Eq. (4)
  test::Rng rng(1);
  MapHierarchy h = emptyHierarchy();
  const auto world = grow(h, rng, 60);
  for (const auto& [id, pose] : world) {
    EXPECT_LT(difference(h.world_T_node(id), pose), 1e-9);
    Pose composed = h.node(id).parent_T_node();
    for (auto p = h.node(id).parent(); p; p = h.node(*p).parent())
      composed = h.node(*p).parent_T_node() + composed;
    EXPECT_LT(difference(h.world_T_node(id), composed), 1e-9);
  }
  expectConsistent(h);
}

TEST(MapHierarchy, AChainOfTenTransformsStaysWithin1e9) {
  test::Rng rng(2);
  MapHierarchy h = emptyHierarchy();
  NodeId parent = kRootId;
  Pose last;
  for (int i = 0; i < 10; ++i) {
    last = test::randomPose(rng, 10.0);
    parent = h.add(labels::object, anyMap(), last, parent);
  }
  EXPECT_EQ(h.depth(parent), 10U);
  EXPECT_LT(difference(h.world_T_node(parent), last), 1e-9);
}

TEST(MapHierarchy, MovingANodeCarriesItsSubtreeRigidly) {  // III-D: t_i <- t_i o t
  test::Rng rng(3);
  MapHierarchy h = emptyHierarchy();
  const auto world = grow(h, rng, 40);
  for (int i = 0; i < 20; ++i) {
    const NodeId moved{static_cast<std::uint32_t>(1 + rng() % 40)};
    const Pose motion = test::randomPose(rng, 0.5);
    std::map<NodeId, Pose> before;
    for (const NodeId id : h.ids()) before[id] = h.world_T_node(id);
    h.move(moved, motion);
    const Pose displacement = (before[moved] + motion) + (-before[moved]);  // in the world
    for (const NodeId id : h.ids()) {
      bool below = false;
      for (std::optional<NodeId> p = id; p; p = h.node(*p).parent()) below |= *p == moved;
      EXPECT_LT(difference(h.world_T_node(id), below ? displacement + before[id] : before[id]), 1e-8);
    }
  }
  expectConsistent(h);
}

TEST(MapHierarchy, RemovingKeepsTheWorldPosesOfTheRest) {
  test::Rng rng(4);
  MapHierarchy h = emptyHierarchy();
  const auto world = grow(h, rng, 40);
  for (int i = 0; i < 30; ++i) {
    const auto ids = h.ids();
    const NodeId victim = ids[1 + rng() % (ids.size() - 1)];
    const auto orphans = h.node(victim).children();
    const NodeId heir = *h.node(victim).parent();
    const MapNode removed = h.remove(victim);
    EXPECT_EQ(removed.id(), victim);
    EXPECT_FALSE(h.contains(victim));
    for (const NodeId orphan : orphans) EXPECT_EQ(h.node(orphan).parent(), heir);
    for (const NodeId id : h.ids()) {
      if (id != kRootId) {
        EXPECT_LT(difference(h.world_T_node(id), world.at(id)), 1e-8);
      }
    }
    expectConsistent(h);
  }
}

TEST(MapHierarchy, IdsAreNeverGivenAgain) {
  MapHierarchy h = emptyHierarchy();
  const NodeId a = h.add(labels::object, anyMap(), Pose(), kRootId);
  h.remove(a);
  const NodeId b = h.add(labels::object, anyMap(), Pose(), kRootId);
  EXPECT_LT(a, b);
  EXPECT_THROW(h.setNextId(b), std::invalid_argument);
  EXPECT_THROW(h.restore(b, labels::object, anyMap(), Pose(), kRootId), std::invalid_argument);
}

TEST(MapHierarchy, ReparentingKeepsTheWorldPoseAndRefusesCycles) {
  test::Rng rng(5);
  MapHierarchy h = emptyHierarchy();
  const NodeId a = h.add(labels::table, anyMap(), test::randomPose(rng, 1), kRootId);
  const NodeId b = h.add(labels::object, anyMap(), test::randomPose(rng, 1), a);
  const NodeId c = h.add(labels::object, anyMap(), test::randomPose(rng, 1), kRootId);
  const Pose before = h.world_T_node(c);
  h.reparent(c, b);
  EXPECT_LT(difference(h.world_T_node(c), before), 1e-12);
  EXPECT_THROW(h.reparent(a, c), std::invalid_argument);
  EXPECT_THROW(h.reparent(a, a), std::invalid_argument);
  expectConsistent(h);
}

TEST(MapHierarchy, TheRootStays) {
  MapHierarchy h = emptyHierarchy();
  EXPECT_THROW(h.remove(kRootId), std::invalid_argument);
  EXPECT_THROW(h.move(kRootId, Pose()), std::invalid_argument);
  EXPECT_THROW(h.reparent(kRootId, kRootId), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(h.node(NodeId{7})), std::out_of_range);
  EXPECT_THROW(h.add(labels::object, anyMap(), Pose(), NodeId{7}), std::out_of_range);
}

}  // namespace
}  // namespace hoctomap
