// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/geometry/Pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/RandomScenes.h"

namespace hoctomap {
namespace {

double difference(const Pose& a, const Pose& b) {
  return (toIsometry(a).matrix() - toIsometry(b).matrix()).cwiseAbs().maxCoeff();
}

TEST(Pose, ObeysTheGroupLaws) {
  test::Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    const Pose a = test::randomPose(rng, 5.0);
    const Pose b = test::randomPose(rng, 5.0);
    const Pose c = test::randomPose(rng, 5.0);
    EXPECT_LT(difference((a + b) + c, a + (b + c)), 1e-12);
    EXPECT_LT(difference(a + (-a), Pose()), 1e-12);
    EXPECT_LT(difference(a + Pose(), a), 1e-12);
    EXPECT_LT(difference(-(a + b), (-b) + (-a)), 1e-12);
  }
}

TEST(Pose, ActsOnPointsAsItsMatrix) {
  test::Rng rng(2);
  const Pose a = test::randomPose(rng, 2.0);
  const PointCloud points{{1, 2, 3}, {-4, 0, 1}};
  const PointCloud moved = transformed(a, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    a.composePoint(points[i].x(), points[i].y(), points[i].z(), x, y, z);
    EXPECT_LT((moved[i].cast<double>() - Eigen::Vector3d(x, y, z)).norm(), 1e-6);
  }
}

TEST(Pose, MatrixRoundTrip) {
  test::Rng rng(3);
  for (int i = 0; i < 50; ++i) {
    const Pose a = test::randomPose(rng, 100.0);
    EXPECT_EQ(difference(poseFromMatrix(toIsometry(a).matrix()), a), 0.0);
  }
}

TEST(Pose, RefusesMatricesThatAreNoRigidMotion) {
  const Eigen::Matrix4d identity = Eigen::Matrix4d::Identity();
  const auto with = [&](int row, int column, double value) {
    Eigen::Matrix4d m = identity;
    m(row, column) = value;
    return m;
  };
  EXPECT_THROW(static_cast<void>(poseFromMatrix(with(1, 3, -1e300))), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(poseFromMatrix(with(0, 3, std::numeric_limits<double>::quiet_NaN()))),
               std::invalid_argument);
  EXPECT_THROW(static_cast<void>(poseFromMatrix(with(1, 3, std::numeric_limits<double>::infinity()))),
               std::invalid_argument);
  EXPECT_THROW(static_cast<void>(poseFromMatrix(with(0, 0, 2.0))), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(poseFromMatrix(with(2, 2, -1.0))), std::invalid_argument) << "a reflection";
  EXPECT_THROW(static_cast<void>(poseFromMatrix(with(3, 0, 0.1))), std::invalid_argument);
  EXPECT_NO_THROW(static_cast<void>(poseFromMatrix(identity)));
}

TEST(Pose, LongChainsStayOrthonormal) {
  test::Rng rng(4);
  Pose chain;
  for (int i = 0; i < 1000; ++i) chain = orthonormalized(chain + test::randomPose(rng, 0.1));
  const Eigen::Matrix3d r = toIsometry(chain).linear();
  EXPECT_LT((r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(Levelled, TakesUpToZ) {
  test::Rng rng(5);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d up = test::uniformVector(rng, -1.0, 1.0);
    EXPECT_LT((toIsometry(levelled(up)) * up.normalized() - Eigen::Vector3d::UnitZ()).norm(), 1e-9);
  }
  EXPECT_LT(
      (toIsometry(levelled(-Eigen::Vector3d::UnitZ())) * -Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitZ())
          .norm(),
      1e-12);
  EXPECT_LT(difference(levelled(Eigen::Vector3d(0, 0, 3)), Pose()), 1e-15);
  EXPECT_THROW(static_cast<void>(levelled(Eigen::Vector3d::Zero())), std::invalid_argument);
}

}  // namespace
}  // namespace hoctomap
