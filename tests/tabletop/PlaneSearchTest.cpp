// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/tabletop/PlaneSearch.h"

#include <gtest/gtest.h>

#include "hoctomap/tabletop/TabletopConfig.h"

namespace hoctomap {
namespace {

const TabletopSegmentationConfig kConfig;

/// A grid of points on z = 0.7 + slope x.
std::vector<Eigen::Vector3d> grid(int nx, int ny, double slope) {
  std::vector<Eigen::Vector3d> points;
  for (int x = 0; x < nx; ++x)
    for (int y = 0; y < ny; ++y) points.emplace_back(0.02 * x, 0.03 * y, 0.7 + slope * 0.02 * x);
  return points;
}

TEST(RegressionPlane, IsThePlaneOfThePoints) {
  const auto plane = regressionPlane(grid(10, 8, 0.02), kConfig);
  ASSERT_TRUE(plane);
  for (const auto& p : grid(10, 8, 0.02)) EXPECT_NEAR(plane->absDistance(p), 0.0, 1e-9);
  EXPECT_GT(plane->normal().z(), 0.99);
}

TEST(RegressionPlane, OfPointsOnALineOrASteepPlaneThereIsNone) {
  EXPECT_FALSE(regressionPlane(grid(20, 1, 0.0), kConfig));
  EXPECT_FALSE(regressionPlane(grid(1, 20, 0.0), kConfig));
  EXPECT_FALSE(regressionPlane(grid(1, 2, 0.0), kConfig));
  EXPECT_FALSE(regressionPlane(std::vector<Eigen::Vector3d>(5, Eigen::Vector3d(0.1, 0.2, 0.7)), kConfig));
  EXPECT_FALSE(regressionPlane(grid(10, 8, 1.0), kConfig));
}

}  // namespace
}  // namespace hoctomap
