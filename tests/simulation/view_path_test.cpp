// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/simulation/ViewPath.h"

#include <gtest/gtest.h>

#include <numbers>

#include "hoctomap/geometry/Errors.h"
#include "support/RandomScenes.h"

namespace hoctomap::test {
namespace {

Eigen::Vector3d positionOf(const Pose& pose) {
  return {pose.x(), pose.y(), pose.z()};
}

void expectBaseOnFloor(const View& view) {
  EXPECT_NEAR(view.world_T_base.z(), 0.0, 1e-12);
  EXPECT_NEAR(view.world_T_base.pitch(), 0.0, 1e-12);
  EXPECT_NEAR(view.world_T_base.roll(), 0.0, 1e-12);
}

TEST(ViewPath, LookAtPutsTheTargetOnTheAxisAndTheHorizonLevel) {
  Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d eye = uniformVector(rng, -2, 2);
    const Eigen::Vector3d target = uniformVector(rng, -2, 2);
    const View view = lookAt(eye, target);
    const Eigen::Isometry3d world_T_sensor = toIsometry(view.world_T_sensor());
    const Eigen::Vector3d sensor_target = world_T_sensor.inverse() * target;
    EXPECT_LT((sensor_target - Eigen::Vector3d((target - eye).norm(), 0, 0)).norm(), 1e-9);
    EXPECT_NEAR(world_T_sensor.linear().col(1).z(), 0.0, 1e-9);  // y, to the left
    EXPECT_GT(world_T_sensor.linear().col(2).z(), 0.0);          // z, up
    expectBaseOnFloor(view);
  }
}

TEST(ViewPath, LookingStraightDownIsRefused) {
  EXPECT_THROW((void)lookAt({1, 1, 2}, {1, 1, 0}), ConfigError);
  EXPECT_THROW((void)lookAt({1, 1, 1}, {1, 1, 1}), ConfigError);
}

TEST(ViewPath, ViewOfAnyPoseKeepsThePose) {
  Rng rng(2);
  for (int i = 0; i < 100; ++i) {
    const Pose world_T_sensor = randomPose(rng, 3.0);
    const View view = viewOfSensor(world_T_sensor);
    expectBaseOnFloor(view);
    const Eigen::Matrix4d difference =
        toIsometry(view.world_T_sensor()).matrix() - toIsometry(world_T_sensor).matrix();
    EXPECT_LT(difference.norm(), 1e-9);
  }
}

TEST(ViewPath, SweepIncludesBothEnds) {
  ArcPath arc;
  arc.centre = {1, 2};
  arc.radius = 1.5;
  arc.height = 1.2;
  arc.angle_begin = 0.0;
  arc.angle_end = std::numbers::pi / 2;
  arc.target = {1, 2, 0.7};
  arc.views = 7;
  const auto views = sweep(arc);
  ASSERT_EQ(views.size(), 7U);
  EXPECT_LT((positionOf(views.front().world_T_sensor()) - Eigen::Vector3d(2.5, 2, 1.2)).norm(), 1e-9);
  EXPECT_LT((positionOf(views.back().world_T_sensor()) - Eigen::Vector3d(1, 3.5, 1.2)).norm(), 1e-9);
}

TEST(ViewPath, CircleDoesNotRepeatItsStart) {
  ArcPath arc;
  arc.views = 8;
  arc.target = {0, 0, 0.7};
  const auto views = circle(arc);
  ASSERT_EQ(views.size(), 8U);
  const double chord = 2.0 * arc.radius * std::sin(std::numbers::pi / 8);
  for (std::size_t i = 0; i < views.size(); ++i)
    EXPECT_NEAR((positionOf(views[i].world_T_base) - positionOf(views[(i + 1) % 8].world_T_base)).norm(),
                chord, 1e-9);
}

TEST(ViewPath, PathsWithoutViewsOrRadiusAreRefused) {
  ArcPath arc;
  arc.views = 0;
  EXPECT_THROW((void)sweep(arc), ConfigError);
  arc.views = 3;
  arc.radius = 0.0;
  EXPECT_THROW((void)circle(arc), ConfigError);
}

}  // namespace
}  // namespace hoctomap::test
