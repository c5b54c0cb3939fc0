// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/mapping/Registration.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "support/RandomScenes.h"

namespace hoctomap {
namespace {

using test::Rng;
using test::uniform;
using Points = std::vector<Eigen::Vector3f>;

/// Surface points of a box standing on z = 0 with a smaller block on one end: no symmetry.
Points shoe(double length, double width, double height, const Eigen::Vector3d& at, Rng& rng, double noise) {
  const auto face = [&](Points& out, const Eigen::Vector3d& size, const Eigen::Vector3d& base) {
    const int samples =
        static_cast<int>((size.x() * size.y() + size.x() * size.z() + size.y() * size.z()) * 4e5);
    std::normal_distribution<double> normal(0.0, noise);
    for (int i = 0; i < samples; ++i) {
      Eigen::Vector3d p(uniform(rng, 0.0, size.x()), uniform(rng, 0.0, size.y()),
                        uniform(rng, 0.0, size.z()));
      const int side = static_cast<int>(uniform(rng, 0.0, 4.999));
      if (side == 4) p.z() = size.z();
      if (side < 2) p.x() = side == 0 ? 0.0 : size.x();
      if (side == 2 || side == 3) p.y() = side == 2 ? 0.0 : size.y();
      p += base + Eigen::Vector3d(normal(rng), normal(rng), normal(rng));
      out.push_back((p + at).cast<float>());
    }
  };
  Points points;
  face(points, {length, width, height}, {0, 0, 0});
  face(points, {0.4 * length, width, 0.6 * height}, {0, 0, height});
  return points;
}

Points moved(const Points& points, const Eigen::Isometry3d& motion) {
  Points result;
  for (const auto& p : points) result.push_back((motion * p.cast<double>()).cast<float>());
  return result;
}

Eigen::Isometry3d aboutVertical(double yaw, const Eigen::Vector3d& shift, const Eigen::Vector3d& centre) {
  return Eigen::Translation3d(centre + shift) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
         Eigen::Translation3d(-centre);
}

TEST(Registration, FindsTheMotionOfRandomObjects) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    const Eigen::Vector3d at = test::uniformVector(rng, -3.0, 3.0);
    const double length = uniform(rng, 0.1, 0.2);
    const double width = uniform(rng, 0.05, 0.09);
    const double height = uniform(rng, 0.05, 0.1);
    Rng first(seed);
    const Points model = shoe(length, width, height, at, first, 0.001);
    Rng second(seed + 1000);  // other points of the same surface
    const auto motion =
        aboutVertical(uniform(rng, -3.1, 3.1), {uniform(rng, -0.5, 0.5), uniform(rng, -0.5, 0.5), 0.0}, at);
    const Points seen = moved(shoe(length, width, height, at, second, 0.001), motion);
    const Registration r = registerPoints(model, seen, RegistrationConfig{});
    EXPECT_EQ(r.verdict, Match::same)
        << "seed " << seed << " overlaps " << r.overlap_model << ' ' << r.overlap_seen << " rms " << r.rms;
    const Eigen::Vector3d centre = at + Eigen::Vector3d(length, width, height) / 2.0;
    EXPECT_LT((r.motion * centre - motion * centre).norm(), 0.002) << "seed " << seed;
    EXPECT_LT(Eigen::AngleAxisd((r.motion.inverse() * motion).rotation()).angle(),
              1.0 * std::numbers::pi / 180.0)
        << "seed " << seed;
  }
}

TEST(Registration, ObjectsOfOtherShapeAreNotTheSame) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Rng rng(seed);
    const Points model = shoe(0.15, 0.06, 0.06, {0, 0, 0.7}, rng, 0.001);
    const Points longer = shoe(0.19, 0.06, 0.06, {0.3, 0, 0.7}, rng, 0.001);
    const Points taller = shoe(0.15, 0.06, 0.08, {0.3, 0, 0.7}, rng, 0.001);
    EXPECT_NE(registerPoints(model, longer, RegistrationConfig{}).verdict, Match::same);
    EXPECT_NE(registerPoints(model, taller, RegistrationConfig{}).verdict, Match::same);
    const Points cube = shoe(0.06, 0.06, 0.05, {0.3, 0, 0.7}, rng, 0.001);
    EXPECT_NE(registerPoints(model, cube, RegistrationConfig{}).verdict, Match::same);
  }
}

TEST(Registration, WhatTheScanCannotShowDoesNotCount) {
  Rng rng(3);
  const Points model = shoe(0.15, 0.06, 0.06, {0, 0, 0.7}, rng, 0.001);
  const auto motion = aboutVertical(0.5, {0.2, 0.1, 0.0}, {0, 0, 0.7});
  // Half of the object is behind something.
  const double wall = (motion * Eigen::Vector3d(0.075, 0.03, 0.7)).y();
  Points seen;
  for (const auto& p : moved(model, motion)) {
    if (static_cast<double>(p.y()) < wall) seen.push_back(p);
  }
  const auto hidden = [wall](const Eigen::Vector3f& p) {
    return static_cast<double>(p.y()) >= wall ? Sight::hidden : Sight::seen_through;
  };
  EXPECT_NE(registerPoints(model, seen, RegistrationConfig{}).verdict, Match::same);
  const Registration r = registerPoints(model, seen, RegistrationConfig{}, {hidden});
  EXPECT_EQ(r.verdict, Match::same) << r.overlap_model << ' ' << r.overlap_seen << ' ' << r.rms;
  EXPECT_LT((r.motion * Eigen::Vector3d(0, 0, 0.7) - motion * Eigen::Vector3d(0, 0, 0.7)).norm(), 0.003);
}

TEST(Registration, ARoundThingKeepsItsTurn) {
  Rng rng(4);
  const auto can = [&rng](const Eigen::Vector3d& at) {
    Points points;
    for (int i = 0; i < 4000; ++i) {
      const double a = uniform(rng, -std::numbers::pi, std::numbers::pi);
      const double r = i % 4 == 0 ? 0.035 * std::sqrt(uniform(rng, 0.0, 1.0)) : 0.035;
      const double z = i % 4 == 0 ? 0.11 : uniform(rng, 0.0, 0.11);
      points.push_back((at + Eigen::Vector3d(r * std::cos(a), r * std::sin(a), z)).cast<float>());
    }
    return points;
  };
  const Registration r = registerPoints(can({0, 0, 0.7}), can({0.2, -0.1, 0.7}), RegistrationConfig{});
  EXPECT_EQ(r.verdict, Match::same);
  EXPECT_LT((r.motion * Eigen::Vector3d(0, 0, 0.75) - Eigen::Vector3d(0.2, -0.1, 0.75)).norm(), 0.002);
  EXPECT_LT(Eigen::AngleAxisd(r.motion.rotation()).angle(), 0.2);
}

/// Points of the top of a box that stands on z = 0 about the vertical axis, and of the sides that face a
/// direction.
Points seenBox(const Eigen::Vector3d& size, const Eigen::Vector2d& from, Rng& rng) {
  Points points;
  const auto add = [&](double x, double y, double z) {
    points.push_back((Eigen::Vector3d(x, y, z) * 0.5).cwiseProduct(size).cast<float>());
  };
  for (int i = 0; i < 8000; ++i) {
    const double u = uniform(rng, -1.0, 1.0);
    const double v = uniform(rng, -1.0, 1.0);
    add(u, v, 1.0);
    add(from.x() < 0.0 ? -1.0 : 1.0, u, v);
    add(u, from.y() < 0.0 ? -1.0 : 1.0, v);
  }
  for (auto& p : points) p.z() += static_cast<float>(0.5 * size.z());
  return points;
}

TEST(Registration, ABoxThatShowsNewSidesIsHeldByItsOutline) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Rng rng(seed);
    const Eigen::Vector3d size(uniform(rng, 0.07, 0.10), uniform(rng, 0.115, 0.15), uniform(rng, 0.08, 0.15));
    const auto motion = aboutVertical(uniform(rng, 1.7, 3.0), {0.3, 0.1, 0.0}, Eigen::Vector3d::Zero());
    const Eigen::Vector3d sensor(1.0, 0.1, 0.8);
    // The same sensor sees the turned box from its other sides.
    const Eigen::Vector3d in_box = motion.inverse() * sensor;
    const Points model = seenBox(size, {1.0, 1.0}, rng);
    const Points seen = moved(seenBox(size, in_box.head<2>(), rng), motion);
    RegistrationSight sight;
    sight.origin = sensor;
    sight.was_free = [&](const Eigen::Vector3f& p) {
      return ((p.cast<double>() - Eigen::Vector3d(0, 0, 0.5 * size.z())).cwiseAbs() - 0.5 * size).maxCoeff() >
             0.0;
    };
    const Registration r = registerPoints(model, seen, RegistrationConfig{}, sight);
    EXPECT_EQ(r.verdict, Match::same)
        << "seed " << seed << " score " << r.score << " explained " << r.explained;
    const Eigen::Vector3d centre(0.0, 0.0, 0.05);
    EXPECT_LT((r.motion * centre - motion * centre).norm(), 0.005) << "seed " << seed;
    const double off = Eigen::AngleAxisd((r.motion.inverse() * motion).rotation()).angle();
    EXPECT_LT(std::min(off, std::numbers::pi - off), 2.0 * std::numbers::pi / 180.0) << "seed " << seed;
  }
}

TEST(Registration, TurnsThatFitAsWellAreListed) {
  Rng rng(9);
  const Eigen::Vector3d square(0.1, 0.1, 0.1);
  const auto motion = aboutVertical(0.2, {0.3, 0.1, 0.0}, Eigen::Vector3d::Zero());
  const Points model = seenBox(square, {1.0, 1.0}, rng);
  const Registration r = registerPoints(model, moved(model, motion), RegistrationConfig{});
  EXPECT_EQ(r.verdict, Match::same);
  EXPECT_TRUE(r.other_turns.empty()) << "the corner where both sides meet is seen";
  Points tops = model;
  std::erase_if(tops, [](const auto& p) { return p.z() < 0.099F; });
  const Registration of_tops = registerPoints(tops, moved(tops, motion), RegistrationConfig{});
  EXPECT_EQ(of_tops.verdict, Match::same);
  EXPECT_FALSE(of_tops.other_turns.empty());
  for (const double turn : of_tops.other_turns) {
    const double quarters = turn / (0.5 * std::numbers::pi);
    EXPECT_NEAR(quarters, std::round(quarters), 0.05);
  }
}

TEST(Registration, TooFewPointsSayNothing) {
  Rng rng(5);
  const Points model = shoe(0.15, 0.06, 0.06, {0, 0, 0.7}, rng, 0.001);
  EXPECT_NE(registerPoints(model, {}, RegistrationConfig{}).verdict, Match::same);
  EXPECT_NE(registerPoints(Points(model.begin(), model.begin() + 3), model, RegistrationConfig{}).verdict,
            Match::same);
}

}  // namespace
}  // namespace hoctomap
