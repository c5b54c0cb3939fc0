// SPDX-License-Identifier: BSD-3-Clause
#include "RegistrationSurface.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "hoctomap/geometry/ForEachIndex.h"

namespace hoctomap {

namespace {

Eigen::Vector3f originOf(std::span<const Eigen::Vector3f> points) {
  return points.empty() ? Eigen::Vector3f(Eigen::Vector3f::Zero()) : points.front();
}

PointCloud about(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> points) {
  PointCloud moved(points.begin(), points.end());
  for (auto& p : moved) p -= origin;
  return moved;
}

constexpr float kReach = 2.5F;  // spacings that a point's neighbours may be away

/// The neighbourhood of a point.
struct Patch {
  Eigen::Vector3f mean;  ///< from the point
  Eigen::Matrix3f covariance;
};

/// Of the neighbours of a point, those chosen by where they lie from it.
template <typename Choose>
Patch patchAround(const SurfacePoints& surface, const Eigen::Vector3f& p, float radius,
                  const Choose& choose) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  Eigen::Matrix3f squares = Eigen::Matrix3f::Zero();
  float count = 0.0F;
  surface.forPointsNear(p, radius, [&](std::size_t j) {
    const Eigen::Vector3f d = surface.points()[j] - p;
    if (!choose(d)) return;
    sum += d;
    squares += d * d.transpose();
    count += 1.0F;
  });
  const Eigen::Vector3f mean = sum / count;
  return {mean, squares / count - mean * mean.transpose()};
}
Patch patchAround(const SurfacePoints& surface, const Eigen::Vector3f& p, float radius) {
  return patchAround(surface, p, radius, [](const Eigen::Vector3f&) { return true; });
}

/// At the edge of a side: the direction in which it ends.
Eigen::Vector3f outwardOf(const Patch& patch, const Eigen::Vector3f& normal, float radius) {
  // The mean of a half disc is 0.42 radii from the middle of its straight edge.
  constexpr float kAtEdge = 0.25F;
  const Eigen::Vector3f inward = patch.mean - normal * normal.dot(patch.mean);
  const float distance = inward.norm();
  if (distance <= kAtEdge * radius) return Eigen::Vector3f::Zero();
  return -inward / distance;
}

/// m, between neighbouring points; at least `least`.
float spacingOf(const SurfacePoints& surface, float least) {
  // On a square grid the fourth neighbour is one spacing away.
  constexpr std::size_t kSample = 60;
  std::vector<float> distances;
  for (std::size_t i = 0; i < surface.size(); i += std::max<std::size_t>(1, surface.size() / kSample))
    distances.push_back(surface.distanceToNeighbour(surface.points()[i], 4));
  if (distances.empty()) return least;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return std::max(least, *middle);
}

/// Each point moved to the middle of the layer that noise makes of a surface.
PointCloud smoothed(const SurfacePoints& surface, float spacing) {
  const float radius = kReach * spacingOf(surface, spacing);
  PointCloud points = surface.points();
  forEachIndex(points.size(), [&](std::size_t i) {
    const Patch patch = patchAround(surface, surface.points()[i], radius);
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> axes;
    axes.computeDirect(patch.covariance);
    const Eigen::Vector3f normal = axes.eigenvectors().col(0);
    points[i] += normal * normal.dot(patch.mean);
  });
  return points;
}

}  // namespace

RegistrationSurface::RegistrationSurface(std::span<const Eigen::Vector3f> world_points, double spacing)
    : origin_(originOf(world_points)),
      surface_(smoothed(SurfacePoints(about(origin_, world_points), static_cast<float>(spacing)),
                        static_cast<float>(spacing)),
               static_cast<float>(spacing)) {
  for (const auto& p : points()) {
    centroid_ += p / static_cast<float>(size());
    highest_ = std::max(highest_, p.z());
  }
  spacing_ = spacingOf(surface_, static_cast<float>(spacing));
  describe();
}

void RegistrationSurface::describe() {
  const float radius = kReach * spacing_;
  std::vector<float> variations(size());
  normals_.resize(size());
  outward_.resize(size());
  forEachIndex(size(), [&](std::size_t i) {
    const Patch patch = patchAround(surface_, points()[i], radius);
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> axes;
    axes.computeDirect(patch.covariance);
    normals_[i] = axes.eigenvectors().col(0);
    variations[i] = axes.eigenvalues()[0] / std::max(1e-12F, axes.eigenvalues().sum());
    outward_[i] = outwardOf(patch, normals_[i], radius);
  });
  sharpen(variations);
}

void RegistrationSurface::sharpen(const std::vector<float>& variations) {
  if (size() == 0) return;
  // Of the variance about a point, across the surface: 0.085 on a right-angled crease, and what noise makes.
  constexpr float kCrease = 0.03F;
  std::vector<float> sorted = variations;
  const auto low = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 3);
  std::nth_element(sorted.begin(), low, sorted.end());
  const float plane = *low;
  const float radius = kReach * spacing_;
  const float thickness = 0.5F * spacing_;
  const std::vector<Eigen::Vector3f> smooth = normals_;
  for (std::size_t i = 0; i < size(); ++i) {
    if (variations[i] < plane + kCrease) continue;
    const Eigen::Vector3f& p = points()[i];
    std::optional<std::size_t> side;
    float least = thickness;
    surface_.forPointsNear(p, radius, [&](std::size_t j) {
      const float off = std::abs(smooth[j].dot(p - points()[j]));
      if (variations[j] > plane + 0.5F * kCrease || off >= least) return;
      least = off;
      side = j;
    });
    if (!side) continue;
    normals_[i] = smooth[*side];
    const auto on_side = [&](const Eigen::Vector3f& d) { return std::abs(normals_[i].dot(d)) < thickness; };
    outward_[i] = outwardOf(patchAround(surface_, p, radius, on_side), normals_[i], radius);
  }
}

void RegistrationSurface::orient(
    const std::function<int(const Eigen::Vector3f& point, const Eigen::Vector3f& normal)>& side) {
  constexpr float kAboutThatWay = 0.87F;  // cosine of 30 degrees
  constexpr float kLeastShare = 0.03F;    // of the points: less are normals at edges
  facing_.clear();
  for (std::size_t i = 0; i < size(); ++i)
    facing_.push_back(static_cast<std::int8_t>(side(points()[i], normals_[i])));
  const auto least = static_cast<std::size_t>(kLeastShare * static_cast<float>(size())) + 1;
  std::array<std::size_t, 6UL * kSquares * kSquares> votes{};
  std::array<Eigen::Vector3f, votes.size()> centres;
  for (int face = 0; face < 6; ++face) {
    for (int v = 0; v < kSquares; ++v) {
      for (int u = 0; u < kSquares; ++u) {
        Eigen::Vector3f d;
        d[face / 2] = face % 2 == 0 ? 1.0F : -1.0F;
        d[(face / 2 + 1) % 3] = 2.0F * (static_cast<float>(u) + 0.5F) / kSquares - 1.0F;
        d[(face / 2 + 2) % 3] = 2.0F * (static_cast<float>(v) + 0.5F) / kSquares - 1.0F;
        centres[sideIndex(d)] = d.normalized();
      }
    }
  }
  for (std::size_t i = 0; i < size(); ++i) {
    for (std::size_t k = 0; k < votes.size(); ++k) {
      const float along = centres[k].dot(normals_[i]);
      const bool faces = facing_[i] == 0 ? std::abs(along) > kAboutThatWay
                                         : along * static_cast<float>(facing_[i]) > kAboutThatWay;
      votes[k] += faces ? 1U : 0U;
    }
  }
  for (std::size_t k = 0; k < votes.size(); ++k) sides_[k] = votes[k] >= least;
}

std::size_t RegistrationSurface::sideIndex(const Eigen::Vector3f& direction) {
  Eigen::Index axis = 0;
  const float largest = direction.cwiseAbs().maxCoeff(&axis);
  const auto square = [&](Eigen::Index other) {
    const float at = 0.5F * (direction[other % 3] / largest + 1.0F) * kSquares;
    return std::clamp(static_cast<int>(at), 0, kSquares - 1);
  };
  const int face = 2 * static_cast<int>(axis) + (direction[axis] < 0.0F ? 1 : 0);
  return static_cast<std::size_t>((face * kSquares + square(axis + 2)) * kSquares + square(axis + 1));
}

}  // namespace hoctomap
