// SPDX-License-Identifier: BSD-3-Clause
#include "RegistrationSurface.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

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

}  // namespace

RegistrationSurface::RegistrationSurface(std::span<const Eigen::Vector3f> world_points, double spacing)
    : origin_(originOf(world_points)), surface_(about(origin_, world_points), static_cast<float>(spacing)) {
  for (const auto& p : points()) {
    centroid_ += p / static_cast<float>(size());
    highest_ = std::max(highest_, p.z());
  }
  measureSpacing(static_cast<float>(spacing));
  describe();
}

void RegistrationSurface::measureSpacing(float least) {
  // On a square grid the fourth neighbour is one spacing away.
  constexpr std::size_t kSample = 60;
  std::vector<float> distances;
  for (std::size_t i = 0; i < size(); i += std::max<std::size_t>(1, size() / kSample))
    distances.push_back(surface_.distanceToNeighbour(points()[i], 4));
  spacing_ = least;
  if (distances.empty()) return;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  spacing_ = std::max(least, *middle);
}

void RegistrationSurface::describe() {
  const float radius = 2.5F * spacing_;
  // The mean of a half disc is 0.42 radii from the middle of its straight edge.
  constexpr float kAtEdge = 0.25F;
  normals_.reserve(size());
  outward_.reserve(size());
  for (const auto& p : points()) {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    Eigen::Matrix3f squares = Eigen::Matrix3f::Zero();
    float count = 0.0F;
    surface_.forPointsNear(p, radius, [&](std::size_t i) {
      const Eigen::Vector3f d = points()[i] - p;
      sum += d;
      squares += d * d.transpose();
      count += 1.0F;
    });
    const Eigen::Vector3f mean = sum / count;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> axes;
    axes.computeDirect(squares - count * mean * mean.transpose());
    const Eigen::Vector3f normal = axes.eigenvectors().col(0);
    const Eigen::Vector3f inward = mean - normal * normal.dot(mean);
    const float distance = inward.norm();
    normals_.push_back(normal);
    outward_.push_back(distance > kAtEdge * radius ? Eigen::Vector3f(-inward / distance)
                                                   : Eigen::Vector3f(Eigen::Vector3f::Zero()));
  }
}

}  // namespace hoctomap
