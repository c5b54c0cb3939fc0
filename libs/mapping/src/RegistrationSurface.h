// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <bitset>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
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
  /// At the edge of a side: the direction along it in which it ends, at a crease or altogether. Zero inside.
  [[nodiscard]] const Eigen::Vector3f& outward(std::size_t i) const { return outward_[i]; }

  /// Turns the normals to the side from which a surface is seen. Unless this is done, nothing faces away.
  /// @param side  of a point about the origin and its normal: positive if it is seen from the normal's side,
  ///              negative if from the other one, zero if that is not known
  void orient(const std::function<int(const Eigen::Vector3f& point, const Eigen::Vector3f& normal)>& side);
  [[nodiscard]] bool isOriented() const { return !facing_.empty(); }
  /// Positive: the normal points to where the point was seen from. Zero: not known.
  [[nodiscard]] int facing(std::size_t i) const { return facing_.empty() ? 0 : facing_[i]; }
  /// Whether a part of the surface faces about this way.
  [[nodiscard]] bool hasSide(const Eigen::Vector3f& direction) const { return sides_[sideIndex(direction)]; }

  [[nodiscard]] std::optional<SurfacePoints::Neighbour> nearest(const Eigen::Vector3f& p,
                                                                float radius) const {
    return surface_.nearest(p, radius);
  }
  /// Nearest point of a side that faces along `normal`, or against it.
  [[nodiscard]] std::optional<SurfacePoints::Neighbour> nearestOnSide(const Eigen::Vector3f& p,
                                                                      const Eigen::Vector3f& normal,
                                                                      float radius) const {
    return surface_.nearestOf(p, radius,
                              [&](std::size_t i) { return std::abs(normal.dot(normals_[i])) >= kOneSide; });
  }
  static constexpr float kOneSide = 0.7F;  ///< cosine between normals of one side of an object

 private:
  void describe();
  /// At creases: the normals of the sides that meet there instead of what lies between them, so that each
  /// side has its edge.
  void sharpen(const std::vector<float>& variations);

  /// Directions, by the square of a cube about the origin that they point to.
  static constexpr int kSquares = 4;  // along an edge of the cube
  static std::size_t sideIndex(const Eigen::Vector3f& direction);

  Eigen::Vector3f origin_;
  SurfacePoints surface_;
  std::vector<Eigen::Vector3f> normals_;
  std::vector<Eigen::Vector3f> outward_;
  std::vector<std::int8_t> facing_;
  std::bitset<6UL * kSquares * kSquares> sides_;
  Eigen::Vector3f centroid_ = Eigen::Vector3f::Zero();
  float spacing_ = 0.0F;
  float highest_ = -std::numeric_limits<float>::infinity();
};

}  // namespace hoctomap
