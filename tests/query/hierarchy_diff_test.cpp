// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/query/HierarchyDiff.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "TwoScenes.h"

namespace hoctomap {
namespace {

using test::mapOf;
using test::Rng;
using test::Solids;
using test::viewsAround;

std::string describe(const std::vector<Change>& changes) {
  std::ostringstream text;
  for (const Change& c : changes) {
    text << toString(c.kind) << " A:" << (c.node_a ? std::to_string(c.node_a->value) : "-")
         << " B:" << (c.node_b ? std::to_string(c.node_b->value) : "-") << " " << c.label.name << " at "
         << c.position.transpose() << " score " << c.score << " " << c.detail << "\n";
  }
  return text.str();
}

std::size_t count(const std::vector<Change>& changes, ChangeKind kind) {
  return static_cast<std::size_t>(
      std::count_if(changes.begin(), changes.end(), [kind](const Change& c) { return c.kind == kind; }));
}

const Change* find(const std::vector<Change>& changes, ChangeKind kind) {
  const auto found =
      std::find_if(changes.begin(), changes.end(), [kind](const Change& c) { return c.kind == kind; });
  return found == changes.end() ? nullptr : &*found;
}

/// How far apart two motions put a point, m.
double distance(const Eigen::Isometry3d& x, const Eigen::Isometry3d& y, const Eigen::Vector3d& at) {
  return (x * at - y * at).norm();
}

/// One object goes, one comes, one moves, the table and two objects stay.
struct Story {
  Solids before;
  Solids after;
  Eigen::Isometry3d motion;
  Eigen::Vector3d gone;
  Eigen::Vector3d come;
};

Story randomStory(Rng& rng) {
  Solids all = test::randomTable(rng, 6);
  Story story;
  story.gone = all[1].world_T_centre.translation();
  story.come = all[2].world_T_centre.translation();
  story.before = all;
  story.before.erase(story.before.begin() + 2);
  story.after = all;
  test::Solid& moved = story.after[5];
  story.motion = test::slide(moved.world_T_centre.translation(), test::uniform(rng, -0.04, 0.04),
                             test::uniform(rng, -0.12, -0.08), test::uniform(rng, -0.6, 0.6));
  moved.world_T_centre = story.motion * moved.world_T_centre;
  story.after.erase(story.after.begin() + 1);
  return story;
}

TEST(Diff, OfAMapWithItselfIsEmpty) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    Rng rng(seed);
    const MapHierarchy map = mapOf(test::randomTable(rng, 6), viewsAround(2, 40.0));
    EXPECT_EQ(map.size(), 8U);
    const auto changes = diff(map, map, {});
    EXPECT_TRUE(changes.empty()) << describe(changes);
  }
}

TEST(Diff, AnotherSideOfTheSameThingIsNoChange) {
  for (std::uint64_t seed = 10; seed < 14; ++seed) {
    Rng rng(seed);
    const Solids solids = test::randomTable(rng, 6);
    const MapHierarchy front = mapOf(solids, viewsAround(1, 0.0));
    const MapHierarchy side = mapOf(solids, viewsAround(1, 100.0));
    const MapHierarchy around = mapOf(solids, viewsAround(4, 30.0));
    for (const auto* other : {&side, &around}) {
      const auto changes = diff(front, *other, {});
      EXPECT_EQ(count(changes, ChangeKind::unobservable), changes.size()) << seed << "\n"
                                                                          << describe(changes);
    }
  }
}

TEST(Diff, FindsWhatWasAddedRemovedAndMoved) {
  for (std::uint64_t seed = 20; seed < 26; ++seed) {
    Rng rng(seed);
    const Story story = randomStory(rng);
    const auto changes =
        diff(mapOf(story.before, viewsAround(3)), mapOf(story.after, viewsAround(3, 25.0)), {});
    ASSERT_EQ(changes.size(), 3U) << seed << "\n" << describe(changes);
    const Change* added = find(changes, ChangeKind::added);
    const Change* removed = find(changes, ChangeKind::removed);
    const Change* moved = find(changes, ChangeKind::moved);
    ASSERT_TRUE(added != nullptr && removed != nullptr && moved != nullptr) << describe(changes);
    EXPECT_LT((added->position - story.come).head<2>().norm(), 0.03);
    EXPECT_LT((removed->position - story.gone).head<2>().norm(), 0.03);
    EXPECT_FALSE(added->node_a || removed->node_b);
    EXPECT_LT(distance(moved->motion, story.motion, moved->position), 0.005) << seed;
  }
}

TEST(Diff, TheOtherWayRoundIsTheMirrorImage) {
  for (std::uint64_t seed = 30; seed < 33; ++seed) {
    Rng rng(seed);
    const Story story = randomStory(rng);
    const MapHierarchy a = mapOf(story.before, viewsAround(3));
    const MapHierarchy b = mapOf(story.after, viewsAround(2, 25.0));
    const auto forward = diff(a, b, {});
    auto backward = diff(b, a, {});
    ASSERT_EQ(forward.size(), backward.size()) << describe(forward) << describe(backward);
    for (const Change& change : forward) {
      const ChangeKind mirrored = change.kind == ChangeKind::added     ? ChangeKind::removed
                                  : change.kind == ChangeKind::removed ? ChangeKind::added
                                                                       : change.kind;
      const auto twin = std::find_if(backward.begin(), backward.end(), [&](const Change& c) {
        return c.kind == mirrored && c.node_a == change.node_b && c.node_b == change.node_a;
      });
      ASSERT_NE(twin, backward.end()) << describe(forward) << describe(backward);
      EXPECT_DOUBLE_EQ(twin->score, change.score);
      EXPECT_TRUE(twin->motion.isApprox(change.motion.inverse(), 1e-9));
      EXPECT_EQ(twin->label, change.label);
    }
  }
}

TEST(Diff, AKnownTransformBetweenTheFramesDoesNotMatter) {
  for (std::uint64_t seed = 40; seed < 43; ++seed) {
    Rng rng(seed);
    const Story story = randomStory(rng);
    Eigen::Isometry3d b_T_a = test::slide(Eigen::Vector3d::Zero(), 3.0, -2.0, test::uniform(rng, -3.0, 3.0));
    b_T_a.pretranslate(Eigen::Vector3d(0.0, 0.0, 0.4));
    const auto changes = diff(mapOf(story.before, viewsAround(3)),
                              mapOf(story.after, viewsAround(3, 25.0), 0.004, b_T_a), {}, b_T_a.inverse());
    ASSERT_EQ(changes.size(), 3U) << seed << "\n" << describe(changes);
    const Change* moved = find(changes, ChangeKind::moved);
    ASSERT_NE(moved, nullptr) << describe(changes);
    EXPECT_LT(distance(moved->motion, story.motion, moved->position), 0.006) << seed;
    EXPECT_EQ(count(changes, ChangeKind::added), 1U);
    EXPECT_EQ(count(changes, ChangeKind::removed), 1U);
  }
}

TEST(Diff, TheResolutionsOfTheMapsMayDiffer) {
  for (std::uint64_t seed = 50; seed < 53; ++seed) {
    Rng rng(seed);
    const Story story = randomStory(rng);
    const MapHierarchy fine = mapOf(story.before, viewsAround(3), 0.004);
    const MapHierarchy coarse = mapOf(story.before, viewsAround(3, 15.0), 0.008);
    const auto none = diff(fine, coarse, {});
    EXPECT_TRUE(none.empty()) << seed << "\n" << describe(none);
    const auto changes = diff(fine, mapOf(story.after, viewsAround(3, 25.0), 0.008), {});
    ASSERT_EQ(changes.size(), 3U) << seed << "\n" << describe(changes);
    const Change* moved = find(changes, ChangeKind::moved);
    ASSERT_NE(moved, nullptr) << describe(changes);
    EXPECT_LT(distance(moved->motion, story.motion, moved->position), 0.008) << seed;
  }
}

/// One camera; a mug-sized thing, and a big box between the two.
struct Hidden {
  Solids open;    ///< the thing in full view
  Solids hidden;  ///< a box before it
  Solids gone;    ///< the box alone
};

Hidden hiddenScene() {
  Rng rng(1);
  Hidden scene;
  scene.open = test::randomTable(rng, 0);
  scene.gone = scene.open;
  scene.open.push_back(test::onTable({0.07, 0.09, 0.10}, false, -0.15, 0.0, 0.3));
  scene.gone.push_back(test::onTable({0.10, 0.40, 0.30}, false, 0.12, 0.0, 0.0));
  scene.hidden = scene.open;
  scene.hidden.push_back(scene.gone.back());
  return scene;
}

TEST(Diff, WhatCannotBeSeenIsUnobservableAndNotRemoved) {
  const Hidden scene = hiddenScene();
  const auto front = viewsAround(1);
  for (const Solids* after : {&scene.hidden, &scene.gone}) {  // nobody can tell the two apart
    const auto changes = diff(mapOf(scene.open, front), mapOf(*after, front), {});
    ASSERT_EQ(changes.size(), 2U) << describe(changes);
    EXPECT_EQ(changes[0].kind, ChangeKind::added);
    EXPECT_EQ(changes[1].kind, ChangeKind::unobservable);
    EXPECT_EQ(changes[1].node_a, NodeId{2});
    EXPECT_FALSE(changes[1].node_b);
  }
}

TEST(Diff, WhatTheFirstMapCouldNotSeeIsNotAdded) {
  const Hidden scene = hiddenScene();
  const auto changes = diff(mapOf(scene.gone, viewsAround(1)), mapOf(scene.hidden, viewsAround(4)), {});
  ASSERT_EQ(changes.size(), 1U) << describe(changes);
  EXPECT_EQ(changes[0].kind, ChangeKind::unobservable);
  EXPECT_FALSE(changes[0].node_a);
}

TEST(Diff, SeenFromBehindItIsRemoved) {
  const Hidden scene = hiddenScene();
  const auto changes = diff(mapOf(scene.open, viewsAround(1)), mapOf(scene.gone, viewsAround(2)), {});
  EXPECT_EQ(count(changes, ChangeKind::removed), 1U) << describe(changes);
  EXPECT_EQ(changes.size(), 2U) << describe(changes);
}

TEST(Diff, AnotherThingInTheSamePlaceIsARemovalAndACreation) {
  Rng rng(2);
  Solids before = test::randomTable(rng, 4);
  Solids after = before;
  before.push_back(test::onTable({0.16, 0.10, 0.06}, false, 0.15, 0.36, 0.4));
  after.push_back(test::onTable({0.06, 0.06, 0.22}, true, 0.17, 0.36, 0.0));
  const auto changes = diff(mapOf(before, viewsAround(3)), mapOf(after, viewsAround(3)), {});
  EXPECT_EQ(changes.size(), 2U) << describe(changes);
  EXPECT_EQ(count(changes, ChangeKind::removed), 1U) << describe(changes);
  EXPECT_EQ(count(changes, ChangeKind::added), 1U) << describe(changes);
}

TEST(Diff, AnotherShapeOfMuchTheSameSizeIsChanged) {
  Rng rng(3);
  Solids before = test::randomTable(rng, 4);
  Solids after = before;
  before.push_back(test::onTable({0.12, 0.14, 0.10}, false, 0.15, 0.36, 0.4));
  after.push_back(test::onTable({0.12, 0.14, 0.14}, false, 0.15, 0.36, 0.4));  // with its lid
  const auto changes = diff(mapOf(before, viewsAround(3)), mapOf(after, viewsAround(3)), {});
  ASSERT_EQ(changes.size(), 1U) << describe(changes);
  EXPECT_EQ(changes[0].kind, ChangeKind::changed);
  EXPECT_TRUE(changes[0].node_a && changes[0].node_b);
}

TEST(Diff, AThingMayMoveToWhereAnotherOneStood) {
  Rng rng(6);
  Solids before = test::randomTable(rng, 4);
  Solids after = before;
  const Eigen::Vector3d tin(0.07, 0.07, 0.08);  // it fits into the box that was there
  before.push_back(test::onTable({0.10, 0.13, 0.09}, false, -0.2, 0.36, 0.3));
  before.push_back(test::onTable(tin, true, 0.2, 0.36, 0.0));
  after.push_back(test::onTable(tin, true, -0.2, 0.36, 0.0));
  const auto changes = diff(mapOf(before, viewsAround(3)), mapOf(after, viewsAround(3)), {});
  ASSERT_EQ(changes.size(), 2U) << describe(changes);
  EXPECT_EQ(changes[0].kind, ChangeKind::removed);
  EXPECT_EQ(changes[0].node_a, NodeId{6});
  EXPECT_EQ(changes[1].kind, ChangeKind::moved);
  EXPECT_EQ(changes[1].node_a, NodeId{7});
}

TEST(Diff, ATableThatMovedCarriesItsObjects) {
  for (std::uint64_t seed = 60; seed < 63; ++seed) {
    Rng rng(seed);
    const Solids before = test::randomTable(rng, 5);
    Solids after = before;
    const Eigen::Isometry3d motion = test::slide(Eigen::Vector3d::Zero(), 0.12, -0.10, 0.15);
    for (auto& solid : after) solid.world_T_centre = motion * solid.world_T_centre;
    const auto changes = diff(mapOf(before, viewsAround(3)), mapOf(after, viewsAround(3)), {});
    ASSERT_EQ(changes.size(), 1U) << seed << "\n" << describe(changes);
    EXPECT_EQ(changes[0].kind, ChangeKind::moved);
    EXPECT_EQ(changes[0].label, labels::table);
    EXPECT_EQ(changes[0].carried.size(), 5U);
    EXPECT_LT(distance(changes[0].motion, motion, changes[0].position), 0.01) << seed;
  }
}

TEST(Diff, AnObjectThatMovesAloneDoesNotMoveItsTable) {
  Rng rng(4);
  const Solids before = test::randomTable(rng, 1);
  Solids after = before;
  after[1].world_T_centre =
      test::slide(after[1].world_T_centre.translation(), 0.1, 0.05, 0.3) * after[1].world_T_centre;
  for (const std::size_t views : {1U, 3U}) {
    const auto changes = diff(mapOf(before, viewsAround(views)), mapOf(after, viewsAround(views)), {});
    ASSERT_EQ(changes.size(), 1U) << describe(changes);
    EXPECT_EQ(changes[0].kind, ChangeKind::moved);
    EXPECT_EQ(changes[0].label, labels::object);
  }
}

TEST(Diff, LookAlikesThatSwapAreNoChangeAndWhoWentWhereIsNotGuessed) {
  Rng rng(5);
  const Eigen::Vector3d size(0.08, 0.12, 0.10);
  const auto scene = [&](const std::vector<Eigen::Vector2d>& at) {
    Solids solids = test::randomTable(rng, 0);
    for (const auto& p : at) solids.push_back(test::onTable(size, false, p.x(), p.y(), 0.0));
    return mapOf(solids, viewsAround(3));
  };
  const MapHierarchy a = scene({{-0.2, -0.3}, {-0.2, 0.1}});
  EXPECT_TRUE(diff(a, scene({{-0.2, 0.1}, {-0.2, -0.3}}), {}).empty());
  const auto changes = diff(a, scene({{0.2, -0.2}, {0.2, 0.3}}), {});
  EXPECT_EQ(count(changes, ChangeKind::moved), 0U) << describe(changes);
  EXPECT_EQ(count(changes, ChangeKind::removed), 2U) << describe(changes);
  EXPECT_EQ(count(changes, ChangeKind::added), 2U) << describe(changes);
  for (const Change& change : changes) EXPECT_NE(change.detail.find("looks like"), std::string::npos);
}

TEST(Diff, OfEmptyMapsIsEmpty) {
  const MapHierarchy a(labels::background, NodeMap(0.05, {}));
  const MapHierarchy b(labels::background, NodeMap(0.1, {}));
  EXPECT_TRUE(diff(a, b, {}).empty());
}

}  // namespace
}  // namespace hoctomap
