// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/geometry/Measurement.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/RandomScenes.h"

namespace hoctomap {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

TEST(Unproject, FollowsThePinholeModel) {
  test::Rng rng(1);
  DepthImage image{{4, 3, 10.0, 12.0, 1.5, 1.0}, std::vector<float>(12, 0.0F)};
  for (auto& d : image.depth) d = static_cast<float>(test::uniform(rng, 0.5, 3.0));
  image.depth[5] = 0.0F;
  const Pose world_T_sensor = test::randomPose(rng, 2.0);
  const Measurement m = unproject(image, world_T_sensor, {});
  ASSERT_EQ(m.world_points.size(), 11U);
  ASSERT_EQ(m.pixel_of_point.size(), 11U);
  for (std::size_t i = 0; i < m.world_points.size(); ++i) {
    const auto pixel = static_cast<int>(m.pixel_of_point[i]);
    const Eigen::Vector3d expected =
        toIsometry(world_T_sensor) *
        image.camera.point(pixel % 4, pixel / 4, image.depth[static_cast<std::size_t>(pixel)]);
    EXPECT_LT((m.world_points[i].cast<double>() - expected).norm(), 1e-6);
  }
  EXPECT_EQ(m.dropped_points, 0U) << "no return is not a bad point";
}

TEST(Unproject, DropsAndCountsWhatIsNoRange) {
  DepthImage image{{6, 1, 10.0, 10.0, 3.0, 0.0}, {1.0F, kNan, kInf, -1.0F, 1e30F, 0.05F}};
  const Measurement m = unproject(image, Pose(), {0.1});
  EXPECT_EQ(m.world_points.size(), 1U);
  EXPECT_EQ(m.dropped_points, 5U);
  for (std::size_t i = 1; i < 6; ++i)
    EXPECT_EQ(m.image->depth[i], 0.0F) << "the image agrees with the points";
}

TEST(FromSensorPoints, DropsAndCountsWhatIsNoPoint) {
  const PointCloud points{{1, 0, 0}, {0, 0, 0}, {kNan, 0, 0}, {0, kInf, 0}, {1e30F, 0, 0}, {0.01F, 0, 0}};
  test::Rng rng(2);
  const Pose pose = test::randomPose(rng, 1.0);
  const Measurement m = fromSensorPoints(points, pose, {0.1});
  ASSERT_EQ(m.world_points.size(), 1U);
  EXPECT_EQ(m.dropped_points, 5U);
  EXPECT_FALSE(m.image);
  EXPECT_LT((m.world_points[0].cast<double>() - toIsometry(pose) * Eigen::Vector3d(1, 0, 0)).norm(), 1e-6);
  EXPECT_TRUE(fromSensorPoints({}, pose, {}).world_points.empty());
}

}  // namespace
}  // namespace hoctomap
