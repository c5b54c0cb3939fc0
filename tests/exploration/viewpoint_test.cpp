// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "TableScene.h"
#include "hoctomap/exploration/ViewpointSampler.h"

namespace hoctomap {
namespace {

RobotModel smallRobot() {
  RobotModel robot;
  robot.radius = 0.2;
  robot.min_sensor_height = 1.0;
  robot.max_sensor_height = 1.4;
  return robot;
}

struct Around {
  MapHierarchy hierarchy = testing::roomWithTable();
  TraversabilityMap map{hierarchy, {}, 0.2, 1.3, {1.5, 1.5}};
  TravelCost travel{map, {1.5, 1.5}, 0.5, 3.0};
  TableArea table = *tableArea(hierarchy, testing::kTable, {});
};

TEST(ViewpointSampler, PlacesThatCanBeReachedNearTheTableFacingIt) {
  const Around scene;
  const RobotModel robot = smallRobot();
  ViewpointConfig config;
  config.radius = 0.8;
  config.candidates = 40;
  const ViewpointSampler sampler(config, robot);
  const auto candidates = sampler.sample(scene.table, scene.travel, 5);
  ASSERT_EQ(candidates.size(), 40U);
  std::set<std::pair<double, double>> places;
  int quadrants[4] = {};
  for (const Viewpoint& v : candidates) {
    const Eigen::Vector2d place(v.world_T_base.x(), v.world_T_base.y());
    places.emplace(place.x(), place.y());
    EXPECT_LE(scene.table.distanceTo(place), config.radius);
    EXPECT_TRUE(scene.travel.length(place));
    const Eigen::Isometry3d camera = toIsometry(v.world_T_sensor());
    EXPECT_GE(camera.translation().z(), robot.min_sensor_height);
    EXPECT_LE(camera.translation().z(), robot.max_sensor_height);
    // The optical axis meets the vertical line through the table's middle, a little above its face.
    const Eigen::Vector3d axis = camera.rotation().col(0);
    const double depth = (scene.table.center - place).norm() / axis.head<2>().norm();
    const Eigen::Vector3d met = camera.translation() + depth * axis;
    EXPECT_NEAR((met.head<2>() - scene.table.center).norm(), 0.0, 1e-9);
    EXPECT_NEAR(met.z(), scene.table.top + 0.1, 1e-9);
    ++quadrants[(place.x() > 0 ? 1 : 0) + (place.y() > 0 ? 2 : 0)];
  }
  EXPECT_EQ(places.size(), candidates.size());
  for (const int n : quadrants) EXPECT_GE(n, 6);
}

TEST(ViewpointSampler, TheSameSeedGivesTheSameSet) {
  const Around scene;
  const ViewpointSampler sampler({}, smallRobot());
  const auto text = [&](std::uint64_t seed) {
    std::string all;
    for (const Viewpoint& v : sampler.sample(scene.table, scene.travel, seed))
      all += v.world_T_sensor().asString();
    return all;
  };
  EXPECT_EQ(text(3), text(3));
  EXPECT_NE(text(3), text(4));
}

TEST(ViewpointSampler, NothingWhereNothingCanBeReached) {
  Around scene;
  TraversabilityMap blocked = scene.map;
  blocked.block(scene.table.center, 1.4);
  const TravelCost travel(blocked, {1.5, 1.5}, 0.5, 3.0);
  ViewpointConfig config;
  config.radius = 0.5;
  EXPECT_TRUE(ViewpointSampler(config, smallRobot()).sample(scene.table, travel, 1).empty());
}

}  // namespace
}  // namespace hoctomap
