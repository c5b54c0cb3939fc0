// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/simulation/Shape.h"

#include <cmath>
#include <numbers>
#include <string>

#include "SurfaceOfRevolution.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {
namespace {

void requirePositive(double value, const std::string& what) {
  if (!(value > 0.0) || !std::isfinite(value)) throw ConfigError(what + " must be positive");
}

TriangleMesh surfaceOf(const BoxShape& box) {
  for (const double s : box.size) requirePositive(s, "size of a box");
  TriangleMesh mesh;
  for (unsigned i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner((i & 1U) != 0 ? 0.5 : -0.5, (i & 2U) != 0 ? 0.5 : -0.5,
                                 (i & 4U) != 0 ? 1.0 : 0.0);
    mesh.vertices.emplace_back(corner.cwiseProduct(box.size).cast<float>());
  }
  mesh.triangles = {{0, 3, 1}, {0, 2, 3}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 7, 3}, {2, 6, 7}, {0, 6, 2}, {0, 4, 6}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TriangleMesh surfaceOf(const CylinderShape& cylinder) {
  requirePositive(cylinder.radius, "radius of a cylinder");
  requirePositive(cylinder.height, "height of a cylinder");
  const double r = cylinder.radius;
  const double h = cylinder.height;
  return turn({{0.0, 0.0}, {r, 0.0}, {r, h}, {0.0, h}}, kChordTolerance);
}

TriangleMesh surfaceOf(const SphereShape& sphere) {
  requirePositive(sphere.radius, "radius of a sphere");
  // Chords along the meridians and chords along the parallels add up.
  const double tolerance = 0.5 * kChordTolerance;
  const int rings = segmentsOfCircle(sphere.radius, tolerance) / 2;
  std::vector<Eigen::Vector2d> arc;
  for (int i = 0; i <= rings; ++i) {
    const double angle = std::numbers::pi * i / rings;
    const bool pole = i == 0 || i == rings;
    arc.emplace_back(pole ? 0.0 : sphere.radius * std::sin(angle), sphere.radius * (1.0 - std::cos(angle)));
  }
  return turn(arc, tolerance);
}

void checkProfile(const TurnedShape& shape) {
  const auto& profile = shape.profile;
  if (profile.size() < 2) throw ConfigError("a profile needs at least two points (radius, z)");
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (!profile[i].allFinite() || profile[i].x() < 0.0)
      throw ConfigError("a profile's radii must not be negative");
    if (i > 0 && profile[i].y() < profile[i - 1].y()) throw ConfigError("a profile must go bottom up");
  }
  if (!(profile.back().y() > profile.front().y())) throw ConfigError("a profile needs a height");
  if (shape.wall < 0.0 || !std::isfinite(shape.wall)) throw ConfigError("wall must not be negative");
  if (shape.wall == 0.0) return;
  if (shape.wall >= profile.back().y() - profile.front().y())
    throw ConfigError("wall must be thinner than the profile is high");
  for (const auto& p : profile)
    if (p.y() > profile.front().y() + shape.wall && p.x() <= shape.wall)
      throw ConfigError("wall must be thinner than the radius of a hollow profile");
  if (radiusAt(profile, profile.front().y() + shape.wall) <= shape.wall)
    throw ConfigError("wall must be thinner than the radius of a hollow profile");
}

void checkHandle(const TurnedShape& shape) {
  const Handle& handle = *shape.handle;
  requirePositive(handle.radius, "radius of a handle");
  requirePositive(handle.reach, "reach of a handle");
  if (!(handle.low < handle.high)) throw ConfigError("a handle's lower end must be below its upper end");
  if (handle.low < shape.profile.front().y() || handle.high > shape.profile.back().y())
    throw ConfigError("a handle's ends must lie on the profile");
}

TriangleMesh surfaceOf(const TurnedShape& shape) {
  checkProfile(shape);
  TriangleMesh mesh = turn(closedProfile(shape), kChordTolerance);
  if (shape.handle) {
    checkHandle(shape);
    mesh.append(handleTube(shape), Eigen::Isometry3d::Identity());
  }
  return mesh;
}

TriangleMesh surfaceOf(const TableShape& table) {
  requirePositive(table.thickness, "thickness of a table");
  requirePositive(table.leg, "leg of a table");
  requirePositive(table.height - table.thickness, "height of a table above its legs");
  const auto at = [](double x, double y, double z) {
    return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
  };
  TriangleMesh mesh;
  const double legs = table.height - table.thickness;
  mesh.append(surfaceOf(BoxShape{{table.size.x(), table.size.y(), table.thickness}}), at(0, 0, legs));
  const TriangleMesh leg = surfaceOf(BoxShape{{table.leg, table.leg, legs}});
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      mesh.append(leg, at(x * 0.5 * (table.size.x() - table.leg), y * 0.5 * (table.size.y() - table.leg), 0));
  return mesh;
}

}  // namespace

TriangleMesh tessellate(const Shape& shape) {
  return std::visit([](const auto& s) { return surfaceOf(s); }, shape);
}

}  // namespace hoctomap
