// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hoctomap/geometry/PointCloud.h"
#include "hoctomap/geometry/Pose.h"

namespace hoctomap {

/// A pinhole camera: pixel (u, v) of a point (x forward, y left, z up) is u = cx - fx y / x, v = cy - fy z /
/// x.
struct PinholeCamera {
  int width = 0;
  int height = 0;
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;

  /// Point at pixel (u, v) and depth `x` along the optical axis, in the sensor frame (x forward).
  [[nodiscard]] Eigen::Vector3d point(double u, double v, double x) const {
    return {x, (cx - u) / fx * x, (cy - v) / fy * x};
  }
};

/// Depth along the optical axis for every pixel, row-major, metres; 0 = no return.
struct DepthImage {
  PinholeCamera camera;
  std::vector<float> depth;

  [[nodiscard]] float at(int u, int v) const {
    return depth[static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width) +
                 static_cast<std::size_t>(u)];
  }
};

/// One 3D measurement (z, o_z) of Section III-B: a cloud of endpoints and the sensor origin, both in the
/// world frame.
struct Measurement {
  std::uint64_t scan = 0;            ///< number of the scan in the log, from 0, skipped ones included
  double stamp = 0.0;                ///< seconds since the epoch
  std::string sensor;                ///< sensor label of the log
  Pose world_T_sensor;               ///< x forward, y left, z up
  PointCloud world_points;           ///< z
  std::uint32_t dropped_points = 0;  ///< returns that were no usable points (not finite, at the origin)

  /// The image the points come from, if the sensor is a depth camera.
  std::optional<DepthImage> image;
  /// With an image: row-major pixel index of every point. Otherwise empty.
  std::vector<std::uint32_t> pixel_of_point;

  /// o_z
  [[nodiscard]] Eigen::Vector3d origin() const {
    return {world_T_sensor.x(), world_T_sensor.y(), world_T_sensor.z()};
  }
};

/// Range and validity limits that turn raw returns into points.
struct RangeLimits {
  double min_range = 0.0;  ///< metres; nearer returns are dropped
};

/// Measurement of a depth camera. Pixels without a return give no point.
[[nodiscard]] Measurement unproject(DepthImage image, const Pose& world_T_sensor, const RangeLimits& limits);

/// Measurement of an unorganised cloud given in the sensor frame. Points that are not finite, beyond 1e6 m,
/// or equal to the origin are dropped and counted.
[[nodiscard]] Measurement fromSensorPoints(const PointCloud& sensor_points, const Pose& world_T_sensor,
                                           const RangeLimits& limits);

}  // namespace hoctomap
