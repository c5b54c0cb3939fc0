// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "ObjectCandidates.h"

namespace hoctomap {

/// A pinhole camera at the origin of an unorganised measurement that looks at the candidates. Its pixels are
/// a little larger than the angle between neighbouring beams, so that surfaces have few holes.
class VirtualCamera {
 public:
  struct Pixel {
    int u;
    int v;
    double w;  ///< 1/m, inverse depth along the axis
  };

  VirtualCamera(const Measurement& z, std::span<const Candidate> candidates);

  [[nodiscard]] const PinholeCamera& pinhole() const { return camera_; }
  /// Nothing if the point is out of view.
  [[nodiscard]] std::optional<Pixel> project(const Eigen::Vector3f& world_point) const;

 private:
  Eigen::Vector3d origin_;
  Eigen::Matrix3d camera_R_world_;  ///< x right, y down, z forward
  PinholeCamera camera_;
};

}  // namespace hoctomap
