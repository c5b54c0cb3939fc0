// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <random>

#include "TableScene.h"
#include "hoctomap/exploration/TraversabilityMap.h"

namespace hoctomap {
namespace {

using State = TraversabilityMap::State;
using testing::box;
using testing::mapOf;

constexpr double kRadius = 0.3;
constexpr double kHeight = 1.3;

State stateAt(const TraversabilityMap& map, double x, double y) {
  const auto cell = map.cellOf({x, y});
  return cell ? map.state(*cell) : State::unknown;
}
bool standsAt(const TraversabilityMap& map, double x, double y) {
  const auto cell = map.cellOf({x, y});
  return cell && map.traversable(*cell);
}

TEST(Traversability, TheTableIsAnObstacleAndWhatNobodySawIsUnknown) {
  const MapHierarchy hierarchy = testing::roomWithTable();
  const TraversabilityMap map(hierarchy, {}, kRadius, kHeight, {1.5, 1.5});
  EXPECT_EQ(stateAt(map, 0.0, 0.0), State::occupied);
  EXPECT_EQ(stateAt(map, 1.0, 0.0), State::free);
  EXPECT_EQ(stateAt(map, 2.2, 0.0), State::unknown);
  EXPECT_TRUE(standsAt(map, 0.9, 0.0));
  EXPECT_FALSE(standsAt(map, 0.75, 0.0)) << "the robot's rim would touch the table";
  EXPECT_FALSE(standsAt(map, 2.2, 0.0));
}

TEST(Traversability, OnlyWhatTheRobotCouldHitCounts) {
  MapHierarchy hierarchy(labels::background,
                         mapOf(0.05, {.free = {box(-2, -2, 0.1, 2, 2, 1.5)},
                                      .occupied = {box(-2, -2, 0, 2, 2, 0.05),         // floor
                                                   box(1, 1, 1.4, 1.5, 1.5, 1.5)}}));  // lamp
  hierarchy.add(labels::object,
                mapOf(0.005, {.free = {}, .occupied = {box(-0.05, -0.05, 0, 0.05, 0.05, 0.2)}}),
                Pose(-1.0, -1.0, 0.3, 0.5, 0.0, 0.0), kRootId);
  const TraversabilityMap map(hierarchy, {}, kRadius, kHeight, {0.0, 0.0});
  EXPECT_EQ(stateAt(map, 0.5, 0.5), State::free);
  EXPECT_EQ(stateAt(map, 1.2, 1.2), State::free) << "above the robot";
  EXPECT_EQ(stateAt(map, -1.0, -1.0), State::occupied) << "an object in its own frame";
}

TEST(Traversability, UnknownIsTraversableIfConfigured) {
  const MapHierarchy hierarchy = testing::roomWithTable();
  TraversabilityConfig config;
  config.unknown_is_free = true;
  const TraversabilityMap map(hierarchy, config, kRadius, kHeight, {1.5, 1.5});
  EXPECT_TRUE(standsAt(map, 2.2, 0.0));
  EXPECT_FALSE(standsAt(map, 0.0, 0.0));
}

TEST(Traversability, TheRobotsOwnFootprintIsFree) {
  const MapHierarchy hierarchy(labels::background,
                               mapOf(0.05, {.free = {}, .occupied = {box(0.0, 0.0, 0.5, 0.05, 0.05, 0.6)}}));
  const TraversabilityMap map(hierarchy, {}, kRadius, kHeight, {0.0, 0.0});
  EXPECT_TRUE(standsAt(map, 0.0, 0.0));
}

TEST(Traversability, GrowingEqualsBruteForce) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    std::mt19937_64 rng(seed);
    std::uniform_real_distribution<double> place(-2.0, 1.9);
    testing::Boxes boxes{.free = {box(-2, -2, 0.1, 2, 2, 1.0)}, .occupied = {}};
    for (int i = 0; i < 12; ++i) {
      const double x = place(rng);
      const double y = place(rng);
      boxes.occupied.push_back(box(x, y, 0.3, x + 0.1, y + 0.1, 0.5));
      boxes.occupied.push_back(box(x, y, 0.3, x + 0.1, y + 0.1, 0.5));  // twice: surely occupied
    }
    const MapHierarchy hierarchy(labels::background, mapOf(0.05, boxes));
    const Eigen::Vector2d robot(place(rng), place(rng));
    const TraversabilityMap map(hierarchy, {}, kRadius, kHeight, robot);
    int stands = 0;
    for (std::size_t i = 0; i < map.cells(); ++i) {
      const GridCell cell = map.cell(i);
      bool expected = map.state(cell) == State::free;
      for (std::size_t j = 0; j < map.cells() && expected; ++j) {
        const Eigen::Vector2d apart = (map.center(cell) - map.center(map.cell(j))).cwiseAbs();
        const double distance = (apart.array() - 0.5 * map.cellSize()).max(0.0).matrix().norm();
        expected = map.state(map.cell(j)) != State::occupied || distance > kRadius + 1e-9;
      }
      ASSERT_EQ(map.traversable(cell), expected) << "seed " << seed << " cell " << cell.x << ' ' << cell.y;
      stands += expected ? 1 : 0;
    }
    EXPECT_GT(stands, 100);
  }
}

TEST(TableArea, NoiseDoesNotLiftTheFace) {
  // Layers of 1 cm, the fuller the nearer to the face at 0.7 m.
  testing::Boxes layers;
  for (const auto& [bottom, share] : {std::pair(0.65, 0.1), std::pair(0.66, 0.3), std::pair(0.67, 0.5),
                                      std::pair(0.68, 0.8), std::pair(0.69, 1.0), std::pair(0.70, 0.7),
                                      std::pair(0.71, 0.5), std::pair(0.72, 0.3), std::pair(0.73, 0.1)}) {
    layers.occupied.push_back(box(-0.5, -0.4, bottom + 0.001, -0.5 + share, 0.4, bottom + 0.009));
  }
  MapHierarchy hierarchy(labels::background, mapOf(0.05, {}));
  const NodeId table = hierarchy.add(labels::table, mapOf(0.01, layers), Pose(), kRootId);
  EXPECT_NEAR(tableArea(hierarchy, table, {})->top, 0.70, 0.006);
}

TEST(TableArea, OutlineFaceAndSpace) {
  MapHierarchy hierarchy = testing::roomWithTable();
  const auto area = tableArea(hierarchy, testing::kTable, {});
  ASSERT_TRUE(area);
  EXPECT_NEAR(area->top, 0.7, 0.011);
  EXPECT_NEAR(area->center.norm(), 0.0, 0.03);
  EXPECT_EQ(area->distanceTo({0.2, 0.1}), 0.0);
  EXPECT_NEAR(area->distanceTo({1.5, 0.0}), 1.0, kOutlineCell);
  EXPECT_TRUE(area->space.contains(Eigen::Vector3d(0.5, 0.3, area->top + 0.29)));
  hierarchy.add(labels::object, mapOf(0.01, {.free = {}, .occupied = {box(0, 0, 0, 0.1, 0.1, 0.5)}}),
                Pose(0, 0, 0.7, 0, 0, 0), testing::kTable);
  EXPECT_GE(tableArea(hierarchy, testing::kTable, {})->space.max().z(), 1.2) << "as high as its objects";
  EXPECT_EQ(tableAreas(hierarchy, {}).size(), 1U);
}

}  // namespace
}  // namespace hoctomap
