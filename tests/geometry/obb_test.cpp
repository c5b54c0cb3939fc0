// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/geometry/Obb.h"

#include <gtest/gtest.h>

#include <optional>

#include "support/RandomScenes.h"

namespace hoctomap {
namespace {

/// What two boxes are by alternating projection, which converges for convex sets: an oracle that shares
/// nothing with the separating-axis test. Together if a point of both is found; apart if the plane across the
/// shortest way found separates them; nothing if it has converged to neither, where boxes nearly touch.
std::optional<bool> areTogetherByProjection(const Obb& a, const Obb& b) {
  const auto project = [](const Obb& obb, const Eigen::Vector3d& p) {
    const Eigen::Vector3d local = obb.world_T_frame.inverse() * p;
    return Eigen::Vector3d(obb.world_T_frame * local.cwiseMax(obb.box.min()).cwiseMin(obb.box.max()));
  };
  Eigen::Vector3d on_b = b.center();
  Eigen::Vector3d on_a = project(a, on_b);
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3d next_b = project(b, on_a);
    const Eigen::Vector3d next_a = project(a, next_b);
    const double step = (next_a - on_a).norm() + (next_b - on_b).norm();
    on_a = next_a;
    on_b = next_b;
    if (step < 1e-13 || (on_a - on_b).norm() < 1e-12) break;
  }
  const Eigen::Vector3d way = on_b - on_a;
  if (way.norm() <= 1e-9) return true;
  const auto reach = [&](const Obb& obb) {
    return (obb.world_T_frame.linear().transpose() * way).cwiseAbs().dot(0.5 * obb.box.sizes());
  };
  if (way.dot(b.center() - a.center()) > reach(a) + reach(b)) return false;
  return std::nullopt;
}

TEST(ObbIntersection, EqualsBruteForceOnRandomBoxes) {
  test::Rng rng(1);
  int intersecting = 0;
  int undecided = 0;
  constexpr int kPairs = 3000;
  for (int i = 0; i < kPairs; ++i) {
    const Obb a = test::randomBox(rng, 1.2);
    const Obb b = test::randomBox(rng, 1.2);
    const std::optional<bool> together = areTogetherByProjection(a, b);
    if (!together) {
      ++undecided;
      continue;
    }
    intersecting += *together ? 1 : 0;
    EXPECT_EQ(intersects(a, b), *together) << "pair " << i;
    EXPECT_EQ(intersects(b, a), intersects(a, b));
  }
  EXPECT_GT(intersecting, kPairs / 10);
  EXPECT_LT(intersecting, kPairs * 9 / 10);
  EXPECT_LT(undecided, kPairs / 50);
}

TEST(ObbIntersection, DecidesFaceEdgeAndCornerContactToAMicrometre) {
  const Eigen::AlignedBox3d unit(Eigen::Vector3d::Constant(-0.5), Eigen::Vector3d::Constant(0.5));
  const Obb fixed{Eigen::Isometry3d::Identity(), unit};
  Obb moved = fixed;
  // Two cubes whose edges cross: only an edge-edge axis separates them.
  moved.world_T_frame.linear() = (Eigen::AngleAxisd(M_PI / 4, Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(M_PI / 4, Eigen::Vector3d::UnitX()))
                                     .toRotationMatrix();
  Obb turned = fixed;
  turned.world_T_frame.linear() = Eigen::AngleAxisd(M_PI / 4, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const double touch = std::sqrt(0.5) + 0.5;
  turned.world_T_frame.translation() = Eigen::Vector3d(0, 0, touch - 1e-6);
  EXPECT_TRUE(intersects(fixed, turned));
  turned.world_T_frame.translation().z() = touch + 1e-6;
  EXPECT_FALSE(intersects(fixed, turned));
  moved.world_T_frame.translation() = Eigen::Vector3d(2.0, 0, 0);
  EXPECT_FALSE(intersects(fixed, moved));
}

TEST(ObbIntersection, AnEmptyBoxIntersectsNothing) {
  test::Rng rng(2);
  const Obb box = test::randomBox(rng, 1.0);
  EXPECT_FALSE(intersects(box, Obb{}));
  EXPECT_FALSE(intersects(Obb{}, Obb{}));
  EXPECT_TRUE(intersects(box, box));
}

TEST(OverlapVolume, OfAlignedBoxesIsExact) {
  const Obb a{Eigen::Isometry3d::Identity(), {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(2, 2, 2)}};
  const Obb b{Eigen::Isometry3d::Identity(), {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(3, 1, 1)}};
  EXPECT_NEAR(overlapVolume(a, b), 1.0, 1e-12);
  EXPECT_NEAR(overlapVolume(b, a), 1.0, 1e-12);
  test::Rng rng(3);
  for (int i = 0; i < 50; ++i) {
    const Obb c = test::randomBox(rng, 1.0);
    EXPECT_NEAR(overlapVolume(c, c), c.box.volume(), 1e-9);
    EXPECT_EQ(overlapVolume(c, c.padded(0.1)), overlapVolume(c.padded(0.1), c));
  }
}

TEST(PcaBox, EnclosesItsPoints) {
  test::Rng rng(4);
  for (int i = 0; i < 50; ++i) {
    const PointCloud cloud = test::boxSurface(rng, test::randomBox(rng, 2.0), 200);
    const Obb box = pcaBox(cloud).padded(1e-6);
    for (const auto& p : cloud) EXPECT_TRUE(box.contains(p.cast<double>()));
    const Eigen::AlignedBox3d bounds = worldBounds(box);
    for (const auto& p : cloud) EXPECT_TRUE(bounds.contains(p.cast<double>()));
  }
  EXPECT_TRUE(pcaBox({}).box.isEmpty());
}

TEST(ClipSegment, AgreesWithSampling) {
  test::Rng rng(5);
  const Eigen::AlignedBox3d box(Eigen::Vector3d(-0.3, -0.5, -0.2), Eigen::Vector3d(0.4, 0.1, 0.6));
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d from = test::uniformVector(rng, -1, 1);
    Eigen::Vector3d to = test::uniformVector(rng, -1, 1);
    if (i % 5 == 0) to.x() = from.x();  // parallel to two faces
    const auto range = clipSegment(from, to, box);
    hits += range ? 1 : 0;
    for (int k = 0; k <= 100; ++k) {
      const double t = k / 100.0;
      const bool inside = box.contains(Eigen::Vector3d(from + t * (to - from)));
      const bool claimed = range && t >= range->first && t <= range->second;
      const double slack = range ? std::min(std::abs(t - range->first), std::abs(t - range->second)) : 1.0;
      if (slack > 1e-9) {
        EXPECT_EQ(inside, claimed);
      }
    }
  }
  EXPECT_GT(hits, 300);
}

}  // namespace
}  // namespace hoctomap
