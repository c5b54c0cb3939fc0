// SPDX-License-Identifier: BSD-3-Clause
#include "ScanBlocks.h"

#include <limits>

namespace hoctomap {
namespace {

constexpr double kHair = 1e-6;  // m, and relative: far more than rounding, far less than a cell

Eigen::AlignedBox2d everything() {
  const Eigen::Vector2d far = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  return {-far, far};
}

}  // namespace

ScanBlocks::ScanBlocks(const Measurement& z) : z_(z) {
  const std::size_t points = z.world_points.size();
  boxes_.reserve(points / kSize + 1);
  for (std::size_t begin = 0; begin < points; begin += kSize) {
    Eigen::AlignedBox3f box;
    const std::size_t end = std::min(points, begin + kSize);
    for (std::size_t i = begin; i < end; ++i) box.extend(z.world_points[i]);
    boxes_.push_back(box.cast<double>());
  }
}

Heights::Heights(const Plane& plane, const Eigen::AlignedBox3d& box) {
  const double middle = plane.signedDistance(box.center());
  const double half = plane.normal().cwiseAbs().dot(box.sizes()) / 2.0;
  const double hair = kHair * (1.0 + std::abs(middle) + half);
  low = middle - half - hair;
  high = middle + half + hair;
}

Eigen::AlignedBox2d crossings(const Plane& plane, const Eigen::Vector3d& origin,
                              const Eigen::AlignedBox3d& box) {
  const double sensor_height = plane.signedDistance(origin);
  Eigen::AlignedBox2d found;
  // Perspective takes the hull of the corners to the hull of their images, as long as none is at the horizon.
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d p = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
    const double below = sensor_height - plane.signedDistance(p);
    if (below < kHair) return everything();
    found.extend((origin + (p - origin) * (sensor_height / below)).head<2>());
  }
  const Eigen::Array2d hair = kHair * (1.0 + found.min().array().abs() + found.max().array().abs());
  return {(found.min().array() - hair).matrix(), (found.max().array() + hair).matrix()};
}

}  // namespace hoctomap
