// SPDX-License-Identifier: BSD-3-Clause
#include "ScanBlocks.h"

#include <gtest/gtest.h>

#include "support/RandomScenes.h"

namespace hoctomap {
namespace {

Measurement randomScan(test::Rng& rng, std::size_t points) {
  Measurement z;
  for (std::size_t i = 0; i < points; ++i)
    z.world_points.push_back(test::uniformVector(rng, -2.0, 2.0).cast<float>());
  return z;
}

Plane randomPlane(test::Rng& rng) {
  return {test::uniformVector(rng, -1.0, 1.0).normalized(), test::uniform(rng, -1.0, 1.0)};
}

Eigen::Vector3d pointIn(const Eigen::AlignedBox3d& box, test::Rng& rng) {
  return box.min() + test::uniformVector(rng, 0.0, 1.0).cwiseProduct(box.sizes());
}

TEST(ScanBlocks, AllPointsAreVisitedInOrder) {
  test::Rng rng(1);
  for (const std::size_t points : {0U, 1U, 63U, 64U, 65U, 1000U}) {
    const Measurement z = randomScan(rng, points);
    std::uint32_t next = 0;
    ScanBlocks(z).visit([](const auto&) { return true; }, [&](std::uint32_t i) { EXPECT_EQ(i, next++); });
    EXPECT_EQ(next, points);
  }
}

TEST(ScanBlocks, ABlockIsKnownByTheBoxOfItsPoints) {
  test::Rng rng(2);
  const Measurement z = randomScan(rng, 200);
  Eigen::AlignedBox3d current;
  ScanBlocks(z).visit(
      [&](const Eigen::AlignedBox3d& box) {
        current = box;
        return true;
      },
      [&](std::uint32_t i) { EXPECT_TRUE(current.contains(z.world_points[i].cast<double>())); });
}

TEST(Heights, BoundTheDistancesOfABoxsPoints) {
  test::Rng rng(3);
  for (int trial = 0; trial < 1000; ++trial) {
    const Plane plane = randomPlane(rng);
    Eigen::AlignedBox3d box(test::uniformVector(rng, -3.0, 3.0));
    box.extend(test::uniformVector(rng, -3.0, 3.0));
    const Heights heights(plane, box);
    EXPECT_LT(heights.high - heights.low, plane.normal().cwiseAbs().dot(box.sizes()) + 1e-3) << "tight";
    for (int i = 0; i < 20; ++i) {
      const double height = plane.signedDistance(pointIn(box, rng));
      EXPECT_GE(height, heights.low);
      EXPECT_LE(height, heights.high);
    }
  }
}

TEST(Crossings, HoldTheCrossingOfEveryBeamThroughTheBox) {
  test::Rng rng(4);
  int bounded = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Plane plane = randomPlane(rng);
    const Eigen::Vector3d origin = test::uniformVector(rng, -3.0, 3.0);
    Eigen::AlignedBox3d box(test::uniformVector(rng, -3.0, 3.0));
    box.extend(box.min() + test::uniformVector(rng, 0.0, 0.5));
    const Eigen::AlignedBox2d found = crossings(plane, origin, box);
    bounded += std::isfinite(found.sizes().sum());
    const double sensor_height = plane.signedDistance(origin);
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3d p = pointIn(box, rng);
      const double height = plane.signedDistance(p);
      if (height >= sensor_height) continue;
      const Eigen::Vector3d crossing = origin + (p - origin) * (sensor_height / (sensor_height - height));
      EXPECT_TRUE(found.contains(crossing.head<2>()));
    }
  }
  EXPECT_GT(bounded, 500) << "most boxes lie on one side";
}

}  // namespace
}  // namespace hoctomap
