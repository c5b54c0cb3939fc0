// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/geometry/PcaFrame.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/RandomScenes.h"

namespace hoctomap {
namespace {

Eigen::Matrix3d axes(const Pose& pose) {
  return toIsometry(pose).linear();
}

bool isIdentity(const Pose& pose) {
  return axes(pose).isIdentity(1e-9);
}

TEST(PcaFrame, IsRightHandedWithFixedSigns) {
  test::Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    const PointCloud cloud = test::boxSurface(rng, test::randomBox(rng, 2.0), 100);
    const Eigen::Matrix3d a = axes(pcaFrame(cloud));
    EXPECT_TRUE((a.transpose() * a).isIdentity(1e-9));
    EXPECT_NEAR(a.determinant(), 1.0, 1e-9);
    for (int column = 0; column < 2; ++column) {
      Eigen::Index largest = 0;
      a.col(column).cwiseAbs().maxCoeff(&largest);
      EXPECT_GT(a(largest, column), 0.0);
    }
  }
}

TEST(PcaFrame, VarianceDecreasesAlongTheAxes) {
  test::Rng rng(2);
  for (int i = 0; i < 50; ++i) {
    const PointCloud cloud = test::boxSurface(rng, test::randomBox(rng, 2.0), 300);
    const PointCloud local = transformed(-pcaFrame(cloud), cloud);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Vector3d square = Eigen::Vector3d::Zero();
    for (const auto& p : local) {
      mean += p.cast<double>();
      square += p.cast<double>().cwiseAbs2();
    }
    EXPECT_LT(mean.norm() / 300.0, 1e-5) << "the origin is the centroid";
    EXPECT_GE(square.x(), square.y());
    EXPECT_GE(square.y(), square.z());
  }
}

TEST(PcaFrame, FollowsTranslationAndIgnoresOrder) {
  test::Rng rng(3);
  PointCloud cloud = test::boxSurface(rng, test::randomBox(rng, 0.5), 200);
  const Pose frame = pcaFrame(cloud);
  PointCloud moved = cloud;
  for (auto& p : moved) p += Eigen::Vector3f(0.5F, -0.25F, 0.125F);
  EXPECT_TRUE(axes(pcaFrame(moved)).isApprox(axes(frame), 1e-5));
  EXPECT_NEAR(pcaFrame(moved).x(), frame.x() + 0.5, 1e-6);
  std::reverse(cloud.begin(), cloud.end());
  EXPECT_TRUE(axes(pcaFrame(cloud)).isApprox(axes(frame), 1e-9));
}

TEST(PcaFrame, DegenerateCloudsFallBackOnWorldAxes) {
  EXPECT_TRUE(isIdentity(pcaFrame({})));
  const PointCloud two{{1, 2, 3}, {2, 2, 4}};
  EXPECT_TRUE(isIdentity(pcaFrame(two)));
  EXPECT_DOUBLE_EQ(pcaFrame(two).x(), 1.5);
  const PointCloud same(10, Eigen::Vector3f(1, 1, 1));
  EXPECT_TRUE(isIdentity(pcaFrame(same)));
  const PointCloud isotropic{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  EXPECT_TRUE(isIdentity(pcaFrame(isotropic)));
}

TEST(PcaFrame, ALineFixesTheFirstAxisOnly) {
  PointCloud line;
  for (int i = 0; i < 20; ++i) line.emplace_back(static_cast<float>(i), 2.0F * static_cast<float>(i), 0.0F);
  const Eigen::Matrix3d a = axes(pcaFrame(line));
  EXPECT_TRUE(a.col(0).isApprox(Eigen::Vector3d(1, 2, 0).normalized(), 1e-6));
  EXPECT_TRUE(a.col(1).isApprox(Eigen::Vector3d::UnitZ(), 1e-6)) << "the least aligned world axis";
}

TEST(PcaFrame, ADiscFixesItsNormalOnly) {
  const PointCloud square{{1, 1, 0}, {1, -1, 0}, {-1, 1, 0}, {-1, -1, 0}};
  const Eigen::Matrix3d a = axes(pcaFrame(square));
  EXPECT_TRUE(a.isIdentity(1e-9)) << a;
}

}  // namespace
}  // namespace hoctomap
