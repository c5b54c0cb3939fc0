// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>

#include "TableScene.h"
#include "hoctomap/exploration/TravelCost.h"

namespace hoctomap {
namespace {

using testing::box;
using testing::mapOf;

constexpr double kRadius = 0.175;

/// A room with pillars at random.
MapHierarchy pillars(std::uint64_t seed, int count) {
  std::mt19937_64 rng(seed);
  std::uniform_real_distribution<double> place(-1.5, 1.3);
  testing::Boxes boxes{.free = {box(-1.5, -1.5, 0.1, 1.5, 1.5, 0.5)}, .occupied = {}};
  for (int i = 0; i < count; ++i) {
    const double x = place(rng);
    const double y = place(rng);
    boxes.occupied.insert(boxes.occupied.end(), 2, box(x, y, 0.2, x + 0.2, y + 0.2, 0.4));
  }
  return MapHierarchy(labels::background, mapOf(0.05, boxes));
}

/// Bellman and Ford, over all pairs of neighbouring cells until nothing changes.
std::vector<double> bruteForce(const TraversabilityMap& map, std::size_t start) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::vector<double> lengths(map.cells(), kFar);
  lengths[start] = 0.0;
  const auto stands = [&map](int x, int y) {
    return x >= 0 && y >= 0 && x < map.width() && y < map.height() && map.traversable({x, y});
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < map.cells(); ++i) {
      const GridCell c = map.cell(i);
      if (!map.traversable(c)) continue;
      for (int dx = -1; dx <= 1; ++dx) {
        for (int dy = -1; dy <= 1; ++dy) {
          if (!stands(c.x + dx, c.y + dy) || !stands(c.x + dx, c.y) || !stands(c.x, c.y + dy)) continue;
          const double way = lengths[map.index({c.x + dx, c.y + dy})] + map.cellSize() * std::hypot(dx, dy);
          if (way < lengths[i] - 1e-12) {
            lengths[i] = way;
            changed = true;
          }
        }
      }
    }
  }
  return lengths;
}

TEST(TravelCost, EqualsBruteForceAndThePathIsAsLong) {
  int reached = 0;
  int cut_off = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const MapHierarchy hierarchy = pillars(seed, 14);
    const Eigen::Vector2d robot(-1.22, -1.22);
    const TraversabilityMap map(hierarchy, {}, kRadius, 1.0, robot);
    const TravelCost travel(map, robot, 0.5, 3.0);
    const auto start = map.cellOf(robot);
    ASSERT_TRUE(start);
    if (!map.traversable(*start)) continue;  // a pillar stands there
    const std::vector<double> expected = bruteForce(map, map.index(*start));
    for (std::size_t i = 0; i < map.cells(); ++i) {
      const Eigen::Vector2d goal = map.center(map.cell(i));
      const auto length = travel.length(goal);
      ASSERT_EQ(length.has_value(), std::isfinite(expected[i])) << "seed " << seed;
      if (!length) {
        cut_off += map.traversable(map.cell(i)) ? 1 : 0;
        EXPECT_TRUE(travel.path(goal).empty());
        continue;
      }
      ASSERT_NEAR(*length, expected[i], 1e-9);
      EXPECT_DOUBLE_EQ(*travel.seconds(goal), 3.0 + *length / 0.5);
      ++reached;
      if (i % 37 != 0) continue;
      const auto path = travel.path(goal);
      ASSERT_GE(path.size(), 2U);
      EXPECT_EQ(path.front(), robot);
      EXPECT_EQ(path.back(), goal);
      double metres = 0.0;
      for (std::size_t k = 1; k < path.size(); ++k) {
        metres += (path[k] - path[k - 1]).norm();
        const auto cell = map.cellOf(path[k]);
        ASSERT_TRUE(cell && map.traversable(*cell));
      }
      EXPECT_NEAR(metres, *length,
                  2.0 * map.cellSize());  // the robot need not stand in the middle of its cell
    }
  }
  EXPECT_GT(reached, 1000);
  EXPECT_GT(cut_off, 0) << "no seed has a place that cannot be reached: the test says less than it should";
}

TEST(TravelCost, ARobotThatStandsWhereItCannotStartsFromTheNearestPlace) {
  const MapHierarchy hierarchy = testing::roomWithTable();
  const TraversabilityMap map(hierarchy, {}, kRadius, 1.0, {1.5, 0.0});
  const TravelCost travel(map, {0.55, 0.0}, 0.5, 0.0);  // too near to the table
  EXPECT_TRUE(travel.length({1.5, 0.0}));
}

TEST(TravelCost, NowhereToStand) {
  const MapHierarchy hierarchy = testing::roomWithTable();
  TraversabilityMap map(hierarchy, {}, kRadius, 1.0, {1.5, 0.0});
  map.block({0.0, 0.0}, 10.0);
  const TravelCost travel(map, {1.5, 0.0}, 0.5, 0.0);
  EXPECT_FALSE(travel.length({1.5, 0.0}));
  EXPECT_TRUE(travel.path({1.0, 0.0}).empty());
}

}  // namespace
}  // namespace hoctomap
