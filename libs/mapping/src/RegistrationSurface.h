// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <span>
#include <vector>

#include "SurfacePoints.h"

namespace hoctomap {

/// A surface made ready to be registered, as often as one likes: points about an origin of their own (single
/// precision near the world's origin is not that of far away), with normals and the outline.
class RegistrationSurface {
 public:
  /// @param world_points  on the surface, m
  /// @param spacing       m, between the points that are kept
  RegistrationSurface(std::span<const Eigen::Vector3f> world_points, double spacing);

  [[nodiscard]] const std::vector<Eigen::Vector3f>& points() const { return surface_.points(); }
  [[nodiscard]] std::size_t size() const { return surface_.size(); }
  [[nodiscard]] const Eigen::Vector3f& origin() const { return origin_; }
  [[nodiscard]] const Eigen::Vector3f& centroid() const { return centroid_; }
  [[nodiscard]] float highest() const { return highest_; }
  /// m, between neighbouring points: at least that asked for, and more where less was seen.
  [[nodiscard]] float spacing() const { return spacing_; }

  /// Of the surface at a point; its sign means nothing.
  [[nodiscard]] const Eigen::Vector3f& normal(std::size_t i) const { return normals_[i]; }
  /// At the edge of the surface: the direction along the surface in which it ends. Zero inside.
  [[nodiscard]] const Eigen::Vector3f& outward(std::size_t i) const { return outward_[i]; }

  [[nodiscard]] std::optional<SurfacePoints::Neighbour> nearest(const Eigen::Vector3f& p,
                                                                float radius) const {
    return surface_.nearest(p, radius);
  }

 private:
  void measureSpacing(float least);
  void describe();

  Eigen::Vector3f origin_;
  SurfacePoints surface_;
  std::vector<Eigen::Vector3f> normals_;
  std::vector<Eigen::Vector3f> outward_;
  Eigen::Vector3f centroid_ = Eigen::Vector3f::Zero();
  float spacing_ = 0.0F;
  float highest_ = -std::numeric_limits<float>::infinity();
};

}  // namespace hoctomap
