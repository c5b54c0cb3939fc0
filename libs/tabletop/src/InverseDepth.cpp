// SPDX-License-Identifier: BSD-3-Clause
#include "InverseDepth.h"

#include <algorithm>

namespace hoctomap {

void PatchMoments::add(const PatchMoments& other, double weight) {
  n += weight * other.n;
  u += weight * other.u;
  v += weight * other.v;
  w += weight * other.w;
  uu += weight * other.uu;
  uv += weight * other.uv;
  vv += weight * other.vv;
  uw += weight * other.uw;
  vw += weight * other.vw;
  ww += weight * other.ww;
}

PatchPlane PatchMoments::plane(double ridge) const {
  PatchPlane plane;
  if (n <= 0.0) return plane;
  plane.u = u / n;
  plane.v = v / n;
  const double suu = uu - u * plane.u + ridge;
  const double suv = uv - u * plane.v;
  const double svv = vv - v * plane.v + ridge;
  const double suw = uw - u * (w / n);
  const double svw = vw - v * (w / n);
  const double determinant = suu * svv - suv * suv;
  if (determinant > 0.0) {
    plane.a = (suw * svv - svw * suv) / determinant;
    plane.b = (svw * suu - suw * suv) / determinant;
  }
  plane.c = w / n - plane.a * plane.u - plane.b * plane.v;
  return plane;
}

double PatchMoments::meanSquaredError(const PatchPlane& p) const {
  const double sum = ww + p.a * p.a * uu + p.b * p.b * vv + n * p.c * p.c +
                     2.0 * (p.a * p.b * uv + p.a * p.c * u + p.b * p.c * v - p.a * uw - p.b * vw - p.c * w);
  return std::max(0.0, sum / n);
}

Eigen::Vector3d normalOf(const PatchPlane& plane, const InverseDepthImage& image) {
  // 1/z = a u + b v + c with u = cx + fx x/z, v = cy + fy y/z is linear in (x, y, z).
  const Eigen::Vector3d away(plane.a * image.fx, plane.b * image.fy,
                             plane.a * image.cx + plane.b * image.cy + plane.c);
  return -away.normalized();
}

std::vector<std::vector<std::size_t>> enclosedIslands(const InverseDepthImage& image, double least,
                                                      double most) {
  const auto width = static_cast<std::size_t>(image.width);
  const auto height = static_cast<std::size_t>(image.height);
  std::vector<std::vector<std::size_t>> islands;
  std::vector<std::uint8_t> seen(image.object);
  std::vector<std::size_t> pixels;
  const double pixel_angle2 = 1.0 / (image.fx * image.fy);
  for (std::size_t seed = 0; seed < image.size(); ++seed) {
    if (seen[seed]) continue;
    seen[seed] = 1;
    pixels.assign(1, seed);
    bool at_border = false;
    std::size_t valid = 0;
    double w = 0.0;
    const auto enter = [&](std::size_t to) {
      if (seen[to]) return;
      seen[to] = 1;
      pixels.push_back(to);
    };
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      const std::size_t at = pixels[k];
      const float value = image.w[at];
      valid += value > 0.0F;
      w += static_cast<double>(value);
      const std::size_t u = at % width;
      const std::size_t v = at / width;
      at_border = at_border || u == 0 || v == 0 || u == width - 1 || v == height - 1;
      if (u > 0) enter(at - 1);
      if (u + 1 < width) enter(at + 1);
      if (v > 0) enter(at - width);
      if (v + 1 < height) enter(at + width);
    }
    if (at_border || 2 * valid <= pixels.size()) continue;
    const double mean_w = w / static_cast<double>(valid);
    const double area = static_cast<double>(pixels.size()) * pixel_angle2 / (mean_w * mean_w);
    if (area >= least && area <= most) islands.push_back(pixels);
  }
  return islands;
}

}  // namespace hoctomap
