// SPDX-License-Identifier: BSD-3-Clause
// Depths of the simulated camera against the exact intersections of rays with plane, box, sphere and
// cylinder.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "SmallScenes.h"
#include "support/RandomScenes.h"

namespace hoctomap::test {
namespace {

struct Ray {
  Eigen::Vector3d origin, direction;
  [[nodiscard]] Eigen::Vector3d at(double t) const { return origin + t * direction; }
};

/// First hit of a ray given in the shape's frame.
using Intersection = std::function<std::optional<double>(const Ray&)>;

std::optional<double> nearest(std::optional<double> a, std::optional<double> b) {
  if (!a || (b && *b < *a)) return b;
  return a;
}

std::optional<double> meetBox(const Ray& ray, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  double enter = 0.0;
  double leave = 1e9;
  for (int i = 0; i < 3; ++i) {
    double a = (low[i] - ray.origin[i]) / ray.direction[i];
    double b = (high[i] - ray.origin[i]) / ray.direction[i];
    if (a > b) std::swap(a, b);
    enter = std::max(enter, a);
    leave = std::min(leave, b);
  }
  return enter <= leave ? std::optional(enter) : std::nullopt;
}

/// Smaller root of a t^2 + 2 b t + c.
std::optional<double> smallerRoot(double a, double b, double c) {
  const double d = b * b - a * c;
  if (d < 0.0) return std::nullopt;
  return (-b - std::sqrt(d)) / a;
}

std::optional<double> meetSphere(const Ray& ray, const Eigen::Vector3d& centre, double radius) {
  const Eigen::Vector3d o = ray.origin - centre;
  return smallerRoot(ray.direction.squaredNorm(), o.dot(ray.direction), o.squaredNorm() - radius * radius);
}

std::optional<double> meetCylinder(const Ray& ray, double radius, double height) {
  const Eigen::Vector2d o = ray.origin.head<2>();
  const Eigen::Vector2d d = ray.direction.head<2>();
  auto side = smallerRoot(d.squaredNorm(), o.dot(d), o.squaredNorm() - radius * radius);
  if (side && (ray.at(*side).z() < 0.0 || ray.at(*side).z() > height)) side.reset();
  std::optional<double> best = side;
  for (const double z : {0.0, height}) {
    const double t = (z - ray.origin.z()) / ray.direction.z();
    if (ray.at(t).head<2>().norm() <= radius) best = nearest(best, t);
  }
  return best;
}

struct Comparison {
  int hits = 0;
  int disagreements = 0;  ///< one says hit, the other does not
  double worst = 0.0;     ///< metres, of beams less than 80 degrees off the normal
};

/// Looks at the shape, in a random pose, from 0.5 to 1.5 m.
Comparison compare(const Shape& shape, const Intersection& exact, std::uint64_t seed) {
  Rng rng(seed);
  const Pose world_T_solid = randomPose(rng, 2.0);
  Scene scene;
  scene.add(makeSolid("it", SolidLabel::object, shape, world_T_solid));
  const SurfaceExtent extent = surfaceExtent(*scene.solid(SolidId{0}).surface, toIsometry(world_T_solid));
  const Eigen::Vector3d eye =
      extent.box.center() +
      Eigen::Vector3d(uniform(rng, 0.5, 1.0), uniform(rng, -0.7, 0.7), uniform(rng, -0.7, 0.7));
  const Pose world_T_sensor = lookAt(eye, extent.box.center()).world_T_sensor();
  const PinholeCamera camera{160, 120, 250.0, 250.0, 79.5, 59.5};
  const Rendering rendering = render(SceneRaycaster(scene), camera, world_T_sensor, 2);

  Comparison result;
  const Eigen::Isometry3d solid_T_sensor = toIsometry(-world_T_solid + world_T_sensor);
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      const auto t = exact({solid_T_sensor.translation(), solid_T_sensor.linear() * camera.point(u, v, 1.0)});
      const auto depth = static_cast<double>(rendering.image.at(u, v));
      const auto index = static_cast<std::size_t>(v * camera.width + u);
      if (t.has_value() != (depth > 0.0)) ++result.disagreements;
      if (!t || depth == 0.0) continue;
      ++result.hits;
      if (static_cast<double>(rendering.cos_incidence[index]) > std::cos(80.0 * 3.14159265 / 180.0))
        result.worst = std::max(result.worst, std::abs(*t - depth));
    }
  return result;
}

void expectExact(const Shape& shape, const Intersection& exact) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Comparison c = compare(shape, exact, seed);
    EXPECT_GT(c.hits, 300) << "seed " << seed;
    EXPECT_LT(c.worst, 1e-4) << "seed " << seed;
    // Only beams along the silhouette may fall on either side.
    EXPECT_LE(c.disagreements, 4) << "seed " << seed;
  }
}

TEST(ClosedForm, Box) {
  expectExact(BoxShape{{0.3, 0.2, 0.25}}, [](const Ray& ray) {
    return meetBox(ray, {-0.15, -0.1, 0.0}, {0.15, 0.1, 0.25});
  });
}

TEST(ClosedForm, Sphere) {
  expectExact(SphereShape{0.12}, [](const Ray& ray) { return meetSphere(ray, {0, 0, 0.12}, 0.12); });
}

TEST(ClosedForm, Cylinder) {
  expectExact(CylinderShape{0.1, 0.25}, [](const Ray& ray) { return meetCylinder(ray, 0.1, 0.25); });
}

TEST(ClosedForm, TurnedProfileOfACylinderIsACylinder) {
  expectExact(TurnedShape{{{0.1, 0.0}, {0.1, 0.1}, {0.1, 0.25}}, 0.0, std::nullopt},
              [](const Ray& ray) { return meetCylinder(ray, 0.1, 0.25); });
}

TEST(ClosedForm, Plane) {
  Scene scene;
  scene.add(makeSolid("floor", SolidLabel::background, BoxShape{{50, 50, 0.1}}, at(0, 0, -0.1)));
  const PinholeCamera camera{64, 48, 60.0, 60.0, 31.5, 23.5};
  const double height = 1.2;
  const double tilt = 0.7;
  const Rendering rendering =
      render(SceneRaycaster(scene), camera, viewOfBase(0, 0, 0.4, height, tilt).world_T_sensor(), 1);
  for (int v = 0; v < camera.height; ++v) {
    // Below the axis, a beam of slope s falls by x (sin tilt + s cos tilt) over the depth x.
    const double fall = std::sin(tilt) + (v - camera.cy) / camera.fy * std::cos(tilt);
    ASSERT_GT(fall, 0.0);
    for (int u = 0; u < camera.width; ++u)
      ASSERT_NEAR(static_cast<double>(rendering.image.at(u, v)), height / fall, 1e-5 * height / fall);
  }
}

TEST(ClosedForm, NoBeamSlipsThroughASurface) {
  Scene scene;  // a camera inside a sphere and inside a closed box must see a surface everywhere
  scene.add(makeSolid("sphere", SolidLabel::background, SphereShape{1.0}, at(0, 0, 0)));
  const PinholeCamera camera{400, 300, 150.0, 150.0, 199.5, 149.5};
  Rng rng(5);
  for (int i = 0; i < 6; ++i) {
    const Pose inside = at(0, 0, 1) + randomPose(rng, 0.2);
    for (const float z : render(SceneRaycaster(scene), camera, inside, 2).image.depth) ASSERT_GT(z, 0.0F);
  }
}

}  // namespace
}  // namespace hoctomap::test
