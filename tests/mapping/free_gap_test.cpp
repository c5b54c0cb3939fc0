// SPDX-License-Identifier: BSD-3-Clause
// Two parts of a node are two things if a scan sees through between them.
#include "FreeGap.h"

#include <gtest/gtest.h>

namespace hoctomap {
namespace {

/// A wall at 2 m, seen by a camera at the origin that looks along x, and what stands before it.
class Sight {
 public:
  Sight() { image_.depth.assign(320UL * 240UL, 2.0F); }

  /// An upright face of the size (m) at a depth, `left` of the axis; returns its points.
  PointCloud face(float depth, float left, float width, float height) {
    PointCloud points;
    for (int v = 0; v < 240; ++v) {
      for (int u = 0; u < 320; ++u) {
        const Eigen::Vector3f p = image_.camera.point(u, v, static_cast<double>(depth)).cast<float>();
        if (std::abs(p.y() - left) > width / 2 || std::abs(p.z()) > height / 2) continue;
        image_.depth[static_cast<std::size_t>(v * 320 + u)] = depth;
        points.push_back(p);
      }
    }
    return points;
  }

  [[nodiscard]] bool hasGap(const PointCloud& a, const PointCloud& b) const {
    const ScanSight sight(unproject(image_, {}, {}), 0.01, {});
    EXPECT_EQ(hasFreeGap(sight, a, b), hasFreeGap(sight, b, a));
    return hasFreeGap(sight, a, b);
  }

 private:
  DepthImage image_{{320, 240, 300.0, 300.0, 160.0, 120.0}, {}};
};

/// Two faces of 10 cm, 10 cm apart, at 1 m.
struct TwoFaces : Sight {
  PointCloud left = face(1.0F, 0.1F, 0.1F, 0.1F);
  PointCloud right = face(1.0F, -0.1F, 0.1F, 0.1F);
};

TEST(FreeGap, IsWhereAScanSeesThroughBetweenTwoThings) {
  const TwoFaces z;
  EXPECT_TRUE(z.hasGap(z.left, z.right));
  EXPECT_FALSE(z.hasGap(z.left, {}));
}

TEST(FreeGap, IsNoneWhereThePartsHangTogether) {
  TwoFaces z;
  z.face(1.0F, 0.0F, 0.15F, 0.12F);
  EXPECT_FALSE(z.hasGap(z.left, z.right));
}

TEST(FreeGap, IsNoneBehindWhatHidesIt) {
  TwoFaces z;
  z.face(0.5F, 0.0F, 0.03F, 0.2F);
  EXPECT_FALSE(z.hasGap(z.left, z.right));
}

TEST(FreeGap, IsNoneBetweenTheFrontOfAThingAndItsBack) {
  Sight z;
  const PointCloud front = z.face(1.0F, 0.0F, 0.1F, 0.1F);
  PointCloud back;  // known from the other side
  for (const auto& p : front) back.push_back(p + 0.1F * Eigen::Vector3f::UnitX());
  EXPECT_FALSE(z.hasGap(front, back));
}

TEST(FreeGap, MayBeTooNarrowToTell) {
  Sight z;
  const PointCloud left = z.face(1.0F, 0.065F, 0.1F, 0.1F);
  const PointCloud right = z.face(1.0F, -0.065F, 0.1F, 0.1F);
  EXPECT_FALSE(z.hasGap(left, right));
}

TEST(FreeGap, IsNotShownByScansWithoutAnImage) {
  const TwoFaces z;
  Measurement cloud;
  cloud.world_points = z.left;
  EXPECT_FALSE(hasFreeGap(ScanSight(cloud, 0.01, {}), z.left, z.right));
}

}  // namespace
}  // namespace hoctomap
