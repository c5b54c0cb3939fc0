// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/geometry/Measurement.h"

#include <cmath>
#include <utility>

namespace hoctomap {

namespace {

// Far beyond any sensor, and still exact enough in single precision to tell a point from rubbish.
constexpr float kLargestCoordinate = 1e6F;

bool isUsable(const Eigen::Vector3f& p, double min_range) {
  if (!(p.cwiseAbs().maxCoeff() <= kLargestCoordinate)) return false;  // also false for NaN
  const double range = p.cast<double>().norm();
  return range > 0.0 && range >= min_range;
}

}  // namespace

Measurement unproject(DepthImage image, const Pose& world_T_sensor, const RangeLimits& limits) {
  const PinholeCamera& camera = image.camera;
  const Eigen::Isometry3d world_T = toIsometry(world_T_sensor);
  // A pixel's point is its depth times a direction that is affine in u and v.
  const Eigen::Vector3d forward = world_T.linear() * camera.point(0.0, 0.0, 1.0);
  const Eigen::Vector3d per_u = world_T.linear() * Eigen::Vector3d(0.0, -1.0 / camera.fx, 0.0);
  const Eigen::Vector3d per_v = world_T.linear() * Eigen::Vector3d(0.0, 0.0, -1.0 / camera.fy);

  Measurement m;
  m.world_T_sensor = world_T_sensor;
  m.world_points.reserve(image.depth.size());
  m.pixel_of_point.reserve(image.depth.size());
  std::uint32_t pixel = 0;
  for (int v = 0; v < camera.height; ++v) {
    const Eigen::Vector3d row = forward + v * per_v;
    for (int u = 0; u < camera.width; ++u, ++pixel) {
      float& depth = image.depth[pixel];
      if (depth == 0.0F) continue;
      const Eigen::Vector3d direction = row + u * per_u;
      if (!(depth > 0.0F && depth <= kLargestCoordinate) || depth * direction.norm() < limits.min_range) {
        depth = 0.0F;  // NaN, inf, negative, too near: as good as no return
        ++m.dropped_points;
        continue;
      }
      m.world_points.push_back((world_T.translation() + depth * direction).cast<float>());
      m.pixel_of_point.push_back(pixel);
    }
  }
  m.image = std::move(image);
  return m;
}

Measurement fromSensorPoints(const PointCloud& sensor_points, const Pose& world_T_sensor,
                             const RangeLimits& limits) {
  const Eigen::Isometry3d world_T = toIsometry(world_T_sensor);
  Measurement m;
  m.world_T_sensor = world_T_sensor;
  m.world_points.reserve(sensor_points.size());
  for (const auto& p : sensor_points) {
    if (isUsable(p, limits.min_range)) {
      m.world_points.push_back((world_T * p.cast<double>()).cast<float>());
    } else {
      ++m.dropped_points;
    }
  }
  return m;
}

}  // namespace hoctomap
