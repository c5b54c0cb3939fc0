// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceOfRevolution.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hoctomap {
namespace {

using std::numbers::pi;

constexpr double kOnAxis = 1e-9;
constexpr int kTubeSides = 16;
constexpr int kTubeRings = 25;

std::uint32_t addRing(TriangleMesh& mesh, const Eigen::Vector2d& point, int segments) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const int count = point.x() < kOnAxis ? 1 : segments;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * pi * i / segments;
    mesh.vertices.emplace_back(
        Eigen::Vector3d(point.x() * std::cos(angle), point.x() * std::sin(angle), point.y()).cast<float>());
  }
  return first;
}

/// Joins two rings of `n` vertices, or a ring and a pole (a ring of one vertex).
void joinRings(TriangleMesh& mesh, std::uint32_t a, bool a_pole, std::uint32_t b, bool b_pole, int segments) {
  const auto n = static_cast<std::uint32_t>(segments);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    if (!a_pole) mesh.triangles.push_back({a + i, a + j, b_pole ? b : b + i});
    if (!b_pole) mesh.triangles.push_back({a_pole ? a : a + j, b + j, b + i});
  }
}

/// Point at angle `phi` around the tube, in the frame (outwards, y, z) of its ring.
Eigen::Vector3d tubePoint(const Eigen::Vector3d& centre, const Eigen::Vector3d& normal, double radius,
                          double phi) {
  return centre + radius * (std::cos(phi) * normal + std::sin(phi) * Eigen::Vector3d::UnitY());
}

}  // namespace

int segmentsOfCircle(double radius, double tolerance) {
  if (radius <= tolerance) return 8;
  // A chord over an angle 2a leaves its circle by r (1 - cos a).
  const double half_angle = std::acos(1.0 - tolerance / radius);
  return std::clamp(static_cast<int>(std::ceil(pi / half_angle)), 16, 2048);
}

TriangleMesh turn(const std::vector<Eigen::Vector2d>& polyline, double tolerance) {
  double widest = 0.0;
  for (const auto& p : polyline) widest = std::max(widest, p.x());
  const int segments = segmentsOfCircle(widest, tolerance);

  TriangleMesh mesh;
  std::uint32_t previous = 0;
  for (std::size_t i = 0; i < polyline.size(); ++i) {
    const std::uint32_t ring = addRing(mesh, polyline[i], segments);
    if (i > 0)
      joinRings(mesh, previous, polyline[i - 1].x() < kOnAxis, ring, polyline[i].x() < kOnAxis, segments);
    previous = ring;
  }
  return mesh;
}

std::vector<Eigen::Vector2d> closedProfile(const TurnedShape& shape) {
  const auto& outside = shape.profile;
  std::vector<Eigen::Vector2d> closed;
  const double bottom = outside.front().y();
  const double top = outside.back().y();
  if (outside.front().x() > kOnAxis) closed.emplace_back(0.0, bottom);
  closed.insert(closed.end(), outside.begin(), outside.end());
  if (shape.wall <= 0.0) {
    if (outside.back().x() > kOnAxis) closed.emplace_back(0.0, top);
    return closed;
  }
  const double inner_bottom = bottom + shape.wall;
  for (auto p = outside.rbegin(); p != outside.rend() && p->y() > inner_bottom; ++p)
    closed.emplace_back(p->x() - shape.wall, p->y());
  closed.emplace_back(radiusAt(outside, inner_bottom) - shape.wall, inner_bottom);
  closed.emplace_back(0.0, inner_bottom);
  return closed;
}

double radiusAt(const std::vector<Eigen::Vector2d>& profile, double z) {
  if (z <= profile.front().y()) return profile.front().x();
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const auto& a = profile[i - 1];
    const auto& b = profile[i];
    if (z <= b.y() && b.y() > a.y()) return a.x() + (b.x() - a.x()) * (z - a.y()) / (b.y() - a.y());
  }
  return profile.back().x();
}

TriangleMesh handleTube(const TurnedShape& shape) {
  const Handle& handle = *shape.handle;
  const double into_wall = 0.5 * shape.wall;
  const Eigen::Vector3d low(radiusAt(shape.profile, handle.low) - into_wall, 0.0, handle.low);
  const Eigen::Vector3d high(radiusAt(shape.profile, handle.high) - into_wall, 0.0, handle.high);

  // Half an ellipse from the lower to the upper end.
  TriangleMesh mesh;
  for (int ring = 0; ring < kTubeRings; ++ring) {
    const double along = pi * ring / (kTubeRings - 1);
    const double outwards = handle.reach + into_wall;
    const Eigen::Vector3d half_span = 0.5 * (high - low);
    const Eigen::Vector3d centre = 0.5 * (low + high) - std::cos(along) * half_span +
                                   outwards * std::sin(along) * Eigen::Vector3d::UnitX();
    const Eigen::Vector3d tangent =
        (std::sin(along) * half_span + outwards * std::cos(along) * Eigen::Vector3d::UnitX()).normalized();
    const Eigen::Vector3d normal = tangent.cross(Eigen::Vector3d::UnitY());
    for (int side = 0; side < kTubeSides; ++side)
      mesh.vertices.emplace_back(
          tubePoint(centre, normal, handle.radius, 2.0 * pi * side / kTubeSides).cast<float>());
    if (ring > 0) {
      const auto first = static_cast<std::uint32_t>((ring - 1) * kTubeSides);
      joinRings(mesh, first, false, first + kTubeSides, false, kTubeSides);
    }
  }
  return mesh;
}

}  // namespace hoctomap
