// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/tabletop/PlaneSearch.h"

#include <mrpt/math/TPlane.h>
#include <mrpt/math/geometry.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "VoxelIndex.h"

namespace hoctomap {
namespace {

/// Sums over the points of one voxel, relative to its first point.
struct Moments {
  Eigen::Vector3d first;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  int count = 0;

  void add(const Eigen::Vector3d& p) {
    if (count++ == 0) first = p;
    const Eigen::Vector3d d = p - first;
    sum += d;
    squares += d * d.transpose();
  }
  [[nodiscard]] Eigen::Vector3d mean() const { return first + sum / count; }
  [[nodiscard]] Eigen::Matrix3d covariance() const {
    return squares / count - (sum / count) * (sum / count).transpose();
  }
};

/// Flat and horizontal, as far as its few noisy points can tell.
bool isHorizontal(const Moments& m, double tolerance) {
  constexpr int kFewestPoints = 4;
  constexpr double kLargestTilt = 30.0 * std::numbers::pi / 180.0;
  constexpr double kSmallestSpread =
      0.003;  // m, along the shorter axis: below it a row of points has no normal
  if (m.count < kFewestPoints) return false;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(m.covariance());
  const double thickness = std::sqrt(std::max(0.0, solver.eigenvalues()[0]));
  const double width = std::sqrt(std::max(0.0, solver.eigenvalues()[1]));
  return thickness < tolerance && width > kSmallestSpread && width > 1.5 * thickness &&
         std::abs(solver.eigenvectors()(2, 0)) > std::cos(kLargestTilt);
}

bool isLevel(const Plane& plane, const TabletopSegmentationConfig& config) {
  return plane.normal().z() >= std::cos(config.plane_max_tilt * std::numbers::pi / 180.0);
}

Plane upward(Plane plane) {
  if (plane.normal().z() < 0.0) plane.coeffs() = -plane.coeffs();
  return plane;
}

std::size_t countInliers(const Plane& plane, std::span<const Surfel> surfels) {
  std::size_t count = 0;
  for (const auto& s : surfels) count += plane.absDistance(s.centroid) < s.tolerance;
  return count;
}

std::optional<Plane> planeThrough(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                  const Eigen::Vector3d& c) {
  // Thin triangles give wild normals: the area must be that of a hand's breadth.
  constexpr double kSmallestArea = 0.005;  // m^2
  const Eigen::Vector3d cross = (b - a).cross(c - a);
  if (cross.norm() < 2.0 * kSmallestArea) return std::nullopt;
  return upward(Plane(cross.normalized(), a));
}

}  // namespace

std::vector<Surfel> horizontalSurfels(const Measurement& z, const TabletopSegmentationConfig& config) {
  constexpr double kMargin = 0.05;
  const double low = config.table_height_min - kMargin;
  const double high = config.table_height_max + kMargin;
  VoxelIndex voxels;
  std::vector<Moments> moments;
  Eigen::Vector3i last_key = Eigen::Vector3i::Zero();
  std::uint32_t last = 0;
  for (const auto& point : z.world_points) {
    const Eigen::Vector3d p = point.cast<double>();
    if (p.z() < low || p.z() > high) continue;
    const Eigen::Vector3i key = floorOf(p / Surfel::kSize);
    if (key != last_key || moments.empty()) {  // points come in rows: mostly it is the voxel of the last one
      last_key = key;
      last = voxels.insert(key);
      if (last == moments.size()) moments.emplace_back();
    }
    moments[last].add(p);
  }
  std::vector<Surfel> surfels;
  for (const auto& m : moments) {
    const Eigen::Vector3d beam = z.origin() - m.mean();
    const double tolerance = config.surfaceTolerance(beam.norm(), beam.z());
    if (isHorizontal(m, tolerance)) surfels.push_back({m.mean(), tolerance});
  }
  return surfels;
}

std::optional<Plane> dominantPlane(std::span<const Surfel> surfels, const TabletopSegmentationConfig& config,
                                   std::mt19937_64& rng) {
  if (surfels.size() < 3) return std::nullopt;
  std::optional<Plane> best;
  std::size_t best_count = 0;
  for (int draw = 0; draw < config.ransac_draws; ++draw) {
    // Not std::uniform_int_distribution: its numbers differ between standard libraries.
    const auto& a = surfels[rng() % surfels.size()].centroid;
    const auto& b = surfels[rng() % surfels.size()].centroid;
    const auto& c = surfels[rng() % surfels.size()].centroid;
    const auto plane = planeThrough(a, b, c);
    if (!plane || !isLevel(*plane, config)) continue;
    const std::size_t count = countInliers(*plane, surfels);
    if (count > best_count) {
      best = plane;
      best_count = count;
    }
  }
  for (int refit = 0; best && refit < 2; ++refit) {
    std::vector<Eigen::Vector3d> inliers;
    for (const auto& s : surfels) {
      if (best->absDistance(s.centroid) < s.tolerance) inliers.push_back(s.centroid);
    }
    if (const auto refitted = regressionPlane(inliers, config)) best = refitted;
  }
  return best;
}

std::optional<Plane> regressionPlane(std::span<const Eigen::Vector3d> points,
                                     const TabletopSegmentationConfig& config) {
  if (points.size() < 3) return std::nullopt;
  std::vector<mrpt::math::TPoint3D> mrpt_points;
  mrpt_points.reserve(points.size());
  for (const auto& p : points) mrpt_points.emplace_back(p.x(), p.y(), p.z());
  mrpt::math::TPlane fit;
  try {
    mrpt::math::getRegressionPlane(mrpt_points, fit);
  } catch (const std::exception&) {
    return std::nullopt;  // MRPT's only way to say that the points are aligned
  }
  const Eigen::Vector3d normal(fit.coefs[0], fit.coefs[1], fit.coefs[2]);
  if (!(normal.norm() > 0.0)) return std::nullopt;
  const Plane plane = upward(Plane(normal / normal.norm(), fit.coefs[3] / normal.norm()));
  return isLevel(plane, config) ? std::optional(plane) : std::nullopt;
}

}  // namespace hoctomap
