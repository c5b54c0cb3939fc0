// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "hoctomap/geometry/Measurement.h"
#include "hoctomap/geometry/Obb.h"

namespace hoctomap {

/// A measurement as an image of ranges, whatever the sensor: the depth image of a camera, or, for an
/// unorganised cloud, a spherical image of 0.12 degrees with the nearest return of every cell.
class RangeView {
 public:
  struct Pixel {
    float u;
    float v;
    float range;  ///< along the optical axis (camera) or from the origin (spherical)
  };

  explicit RangeView(const Measurement& z);

  /// Where a point in the world is seen; nothing if it lies behind the sensor. May lie outside the image.
  [[nodiscard]] std::optional<Pixel> project(const Eigen::Vector3f& world_point) const;

  /// The point in the world that is seen there at this range, m.
  [[nodiscard]] Eigen::Vector3f worldPoint(const Pixel& pixel) const;

  /// False only if no point of the box is seen inside the image, at a range of at most `range`.
  [[nodiscard]] bool mayShow(const Obb& box, double range) const;

  /// Farthest measured range; 0 if there was no return.
  [[nodiscard]] float farthest() const { return farthest_; }
  /// Box in the world of all that is seen inside the image at a range of at most `range`.
  [[nodiscard]] Eigen::AlignedBox3d worldBounds(double range) const;

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// Pixels per radian: an extent of s metres at range r covers about focal() s / r pixels.
  [[nodiscard]] float focal() const { return focal_; }
  /// Measured range; 0 outside the image or where there was no return.
  [[nodiscard]] float measured(int u, int v) const { return contains(u, v) ? range_[index(u, v)] : 0.0F; }
  [[nodiscard]] bool contains(int u, int v) const { return u >= 0 && v >= 0 && u < width_ && v < height_; }
  [[nodiscard]] std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u);
  }

 private:
  void makeSpherical(const Measurement& z);

  Eigen::Isometry3f sensor_T_world_;
  bool spherical_ = false;
  int width_ = 0;
  int height_ = 0;
  float focal_ = 0.0F;
  // Camera: principal point and vertical focal length. Spherical: angles of pixel (0, 0).
  float cx_ = 0.0F;
  float cy_ = 0.0F;
  float fy_ = 0.0F;
  float farthest_ = 0.0F;
  std::vector<float> range_;
};

}  // namespace hoctomap
