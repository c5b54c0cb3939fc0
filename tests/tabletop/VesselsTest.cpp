// SPDX-License-Identifier: BSD-3-Clause
#include "Vessels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hoctomap {
namespace {

constexpr double kRadius = 0.045;
constexpr double kRimHeight = 0.10;

/// A table at height 0 in front of a sensor at (-1, 0, 0.6), and walls on it as the sensor would see them.
class Vessels : public testing::Test {
 protected:
  Vessels() { z_.world_T_sensor = Pose(-1.0, 0.0, 0.6, 0.0, 0.0, 0.0); }

  /// Half a round wall around (x, 0): the half that faces the sensor, or the one that faces away.
  ShapedCluster wall(double x, bool faces_sensor, double lowest, double highest, double radius = kRadius) {
    std::vector<Eigen::Vector3d> points;
    for (double height = lowest; height <= highest + 1e-9; height += 0.004) {
      for (double angle = -80.0; angle <= 80.0; angle += 4.0) {
        const double a = angle * std::numbers::pi / 180.0 + (faces_sensor ? std::numbers::pi : 0.0);
        points.emplace_back(x + radius * std::cos(a), radius * std::sin(a), height);
      }
    }
    return shaped(points, highest);
  }

  ShapedCluster shaped(const std::vector<Eigen::Vector3d>& points, double highest) {
    ShapedCluster cluster;
    cluster.shape.highest = highest;
    double ranges = 0.0;
    std::size_t top = 0;
    for (const auto& p : points) {
      const double range = (p - z_.origin()).norm();
      cluster.points.push_back({static_cast<std::uint32_t>(z_.world_points.size()), 0, p.z(), range});
      z_.world_points.push_back(p.cast<float>());
      cluster.shape.box.extend(p);
      ranges += range;
      top += p.z() > highest - 0.01 ? 1U : 0U;
    }
    const auto count = static_cast<double>(points.size());
    cluster.shape.range = ranges / count;
    cluster.shape.top_share = static_cast<double>(top) / count;
    return cluster;
  }

  std::size_t joined(std::vector<ShapedCluster> clusters) {
    std::size_t points = 0;
    for (const auto& c : clusters) points += c.points.size();
    joinVessels(clusters, z_, TabletopSegmentationConfig{});
    for (const auto& c : clusters) points -= c.points.size();
    EXPECT_EQ(points, 0U) << "points were lost";
    return clusters.size();
  }

  Measurement z_;
};

TEST_F(Vessels, TheFarInnerWallBelongsToTheCup) {
  const auto outer = wall(0.0, true, 0.0, kRimHeight);
  const auto inner = wall(0.0, false, 0.05, kRimHeight);
  EXPECT_EQ(joined({outer, inner}), 1U);
  EXPECT_EQ(joined({inner, outer}), 1U);  // in any order
}

TEST_F(Vessels, AThingBehindTheCupOfAnotherHeightIsNotItsInside) {
  const auto outer = wall(0.0, true, 0.0, kRimHeight);
  EXPECT_EQ(joined({outer, wall(0.0, false, 0.05, kRimHeight + 0.05)}), 2U);
}

TEST_F(Vessels, TwoThingsInARowMakeNoRing) {
  const auto front = wall(0.0, true, 0.0, kRimHeight);
  EXPECT_EQ(joined({front, wall(0.08, false, 0.05, kRimHeight)}), 2U);  // twice as deep as wide
}

TEST_F(Vessels, TheTopOfABoxIsNoInnerWall) {
  std::vector<Eigen::Vector3d> top;
  for (double x = 0.0; x <= kRadius; x += 0.004) {
    for (double y = -kRadius; y <= kRadius; y += 0.004) top.emplace_back(x, y, kRimHeight);
  }
  const auto front = wall(0.0, true, 0.0, kRimHeight);
  EXPECT_EQ(joined({front, shaped(top, kRimHeight)}), 2U);
}

TEST_F(Vessels, WallsThatDoNotTouchStayApart) {
  // As round as a ring, but the gap in the middle is wider than any lost rim.
  const double far = 0.12;
  std::vector<Eigen::Vector3d> front;
  std::vector<Eigen::Vector3d> rear;
  for (double y = -far / 2.0; y <= far / 2.0; y += 0.004) {
    for (double height = 0.05; height <= kRimHeight; height += 0.004) {
      front.emplace_back(0.0, y, height);
      rear.emplace_back(far, y, height);
    }
  }
  EXPECT_EQ(joined({shaped(front, kRimHeight), shaped(rear, kRimHeight)}), 2U);
}

}  // namespace
}  // namespace hoctomap
