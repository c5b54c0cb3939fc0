// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/existence/RangeView.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hoctomap {

namespace {

constexpr float kSphericalStep = 0.12F * std::numbers::pi_v<float> / 180.0F;
constexpr float kNearest = 0.05F;  // m; nearer points have no useful projection

struct Angles {
  float azimuth;    // to the right, as u
  float elevation;  // downwards, as v
  float range;
};

Angles anglesOf(const Eigen::Vector3f& p) {
  const float range = p.norm();
  return {-std::atan2(p.y(), p.x()), -std::asin(std::clamp(p.z() / range, -1.0F, 1.0F)), range};
}

}  // namespace

RangeView::RangeView(const Measurement& z)
    : sensor_T_world_(toIsometry(z.world_T_sensor).inverse().cast<float>()) {
  if (!z.image) {
    makeSpherical(z);
    return;
  }
  const PinholeCamera& camera = z.image->camera;
  width_ = camera.width;
  height_ = camera.height;
  focal_ = static_cast<float>(camera.fx);
  fy_ = static_cast<float>(camera.fy);
  cx_ = static_cast<float>(camera.cx);
  cy_ = static_cast<float>(camera.cy);
  range_ = z.image->depth;
  for (const float range : range_) farthest_ = std::max(farthest_, range);
}

void RangeView::makeSpherical(const Measurement& z) {
  spherical_ = true;
  focal_ = fy_ = 1.0F / kSphericalStep;
  std::vector<Angles> angles;
  angles.reserve(z.world_points.size());
  Eigen::AlignedBox2f field;
  for (const auto& p : z.world_points) {
    const Eigen::Vector3f in_sensor = sensor_T_world_ * p;
    if (in_sensor.norm() < kNearest) continue;
    angles.push_back(anglesOf(in_sensor));
    field.extend(Eigen::Vector2f(angles.back().azimuth, angles.back().elevation));
  }
  if (angles.empty()) return;
  cx_ = field.min().x();
  cy_ = field.min().y();
  width_ = static_cast<int>(field.sizes().x() / kSphericalStep) + 1;
  height_ = static_cast<int>(field.sizes().y() / kSphericalStep) + 1;
  range_.assign(index(0, height_), 0.0F);
  for (const auto& a : angles) {
    const int u = std::min(width_ - 1, static_cast<int>((a.azimuth - cx_) / kSphericalStep));
    const int v = std::min(height_ - 1, static_cast<int>((a.elevation - cy_) / kSphericalStep));
    float& nearest = range_[index(u, v)];
    if (nearest == 0.0F || a.range < nearest) nearest = a.range;
    farthest_ = std::max(farthest_, a.range);
  }
}

std::optional<RangeView::Pixel> RangeView::project(const Eigen::Vector3f& world_point) const {
  const Eigen::Vector3f p = sensor_T_world_ * world_point;
  if (spherical_) {
    if (p.norm() < kNearest) return std::nullopt;
    const Angles a = anglesOf(p);
    return Pixel{(a.azimuth - cx_) / kSphericalStep, (a.elevation - cy_) / kSphericalStep, a.range};
  }
  if (p.x() < kNearest) return std::nullopt;
  return Pixel{cx_ - focal_ * p.y() / p.x(), cy_ - fy_ * p.z() / p.x(), p.x()};
}

Eigen::Vector3f RangeView::worldPoint(const Pixel& pixel) const {
  const auto& [u, v, range] = pixel;
  if (!spherical_)
    return sensor_T_world_.inverse() * (range * Eigen::Vector3f(1.0F, (cx_ - u) / focal_, (cy_ - v) / fy_));
  const float azimuth = cx_ + u * kSphericalStep;  // as in anglesOf
  const float elevation = cy_ + v * kSphericalStep;
  return sensor_T_world_.inverse() *
         (range * Eigen::Vector3f(std::cos(elevation) * std::cos(azimuth),
                                  -std::cos(elevation) * std::sin(azimuth), -std::sin(elevation)));
}

bool RangeView::mayShow(const Obb& box, double range) const {
  if (box.box.isEmpty()) return false;
  const Eigen::Isometry3d sensor_T_box = sensor_T_world_.cast<double>() * box.world_T_frame;
  const double hair =
      1e-4 * (1.0 + sensor_T_box.translation().norm());  // projections are in single precision
  if (spherical_) return box.box.exteriorDistance(sensor_T_box.inverse().translation()) <= range + hair;
  // Outside one of the planes through the camera and an edge of the image, or too near, or too far.
  Eigen::Array<bool, 6, 1> outside = Eigen::Array<bool, 6, 1>::Constant(true);
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d p =
        sensor_T_box * box.box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
    const double u = cx_ * p.x() - focal_ * p.y();  // times x: the pixel
    const double v = cy_ * p.x() - fy_ * p.z();
    outside[0] &= u < -hair * focal_;
    outside[1] &= u > width_ * p.x() + hair * focal_;
    outside[2] &= v < -hair * fy_;
    outside[3] &= v > height_ * p.x() + hair * fy_;
    outside[4] &= p.x() < kNearest - hair;
    outside[5] &= p.x() > range + hair;
  }
  return !outside.any();
}

Eigen::AlignedBox3d RangeView::worldBounds(double range) const {
  const Eigen::Isometry3d world_T_sensor = sensor_T_world_.cast<double>().inverse();
  const Eigen::Vector3d origin = world_T_sensor.translation();
  if (spherical_) return {origin.array() - range, origin.array() + range};
  Eigen::AlignedBox3d bounds(origin);
  for (const double u : {0, width_}) {
    for (const double v : {0, height_}) {
      bounds.extend(world_T_sensor * (range * Eigen::Vector3d(1.0, (cx_ - u) / focal_, (cy_ - v) / fy_)));
    }
  }
  return bounds;
}

}  // namespace hoctomap
