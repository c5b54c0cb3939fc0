// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace hoctomap {

/// A picture of w = 1/depth (1/m), cut out around the objects on a table. In w a plane of space is affine in
/// the pixel, and the noise of a triangulating sensor (structured light, stereo) is the same everywhere.
struct InverseDepthImage {
  int width = 0;
  int height = 0;
  // Pinhole camera of the picture, pixels; x right, y down, z forward.
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;
  std::vector<float> w;              ///< 1/m, row-major; 0 = no return
  std::vector<std::uint8_t> object;  ///< pixels to be segmented; these have a return

  [[nodiscard]] std::size_t size() const { return w.size(); }
  [[nodiscard]] double focalLength() const { return (fx + fy) / 2.0; }
  [[nodiscard]] Eigen::Vector3d point(double u, double v, double inverse_depth) const {
    return Eigen::Vector3d((u - cx) / fx, (v - cy) / fy, 1.0) / inverse_depth;
  }
};

/// What objects enclose, as the floor of a pot that lies in the tolerance of the table's plane: connected
/// pixels that are no object, of an area between `least` and `most` (m^2, as if facing the sensor), with a
/// return in more than half of them.
[[nodiscard]] std::vector<std::vector<std::size_t>> enclosedIslands(const InverseDepthImage& image,
                                                                    double least, double most);

/// w = a u + b v + c, and the place in the picture to which it belongs.
struct PatchPlane {
  double a = 0.0;
  double b = 0.0;
  double c = 0.0;
  double u = 0.0;
  double v = 0.0;

  [[nodiscard]] double at(double at_u, double at_v) const { return a * at_u + b * at_v + c; }
};

/// Sums over the pixels of a patch. They add up, and both the plane and its error follow from them.
struct PatchMoments {
  double n = 0.0;
  double u = 0.0, v = 0.0, w = 0.0;
  double uu = 0.0, uv = 0.0, vv = 0.0;
  double uw = 0.0, vw = 0.0, ww = 0.0;

  /// @param weight  -1 takes a pixel out again
  void add(double pu, double pv, double pw, double weight = 1.0) {
    n += weight;
    u += weight * pu;
    v += weight * pv;
    w += weight * pw;
    uu += weight * pu * pu;
    uv += weight * pu * pv;
    vv += weight * pv * pv;
    uw += weight * pu * pw;
    vw += weight * pv * pw;
    ww += weight * pw * pw;
  }
  void add(const PatchMoments& other, double weight);

  /// Least-squares plane; `ridge` (px^2) holds the slope of few pixels down.
  [[nodiscard]] PatchPlane plane(double ridge) const;
  /// Mean squared distance in w from a plane.
  [[nodiscard]] double meanSquaredError(const PatchPlane& plane) const;
};

/// Normal of a patch's plane in the camera's frame, towards the camera.
[[nodiscard]] Eigen::Vector3d normalOf(const PatchPlane& plane, const InverseDepthImage& image);

}  // namespace hoctomap
