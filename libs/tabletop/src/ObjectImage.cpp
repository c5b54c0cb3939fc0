// SPDX-License-Identifier: BSD-3-Clause
#include "ObjectImage.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "VirtualCamera.h"

namespace hoctomap {
namespace {

struct Crop {
  int left = std::numeric_limits<int>::max();
  int top = std::numeric_limits<int>::max();
  int right = -1;
  int bottom = -1;

  void extend(int u, int v) {
    left = std::min(left, u);
    top = std::min(top, v);
    right = std::max(right, u);
    bottom = std::max(bottom, v);
  }
  /// One pixel more on every side, within the image: what objects enclose does not touch the border.
  void grow(int width, int height) {
    left = std::max(0, left - 1);
    top = std::max(0, top - 1);
    right = std::min(width - 1, right + 1);
    bottom = std::min(height - 1, bottom + 1);
  }
};

ObjectImage emptyImage(const Crop& crop, const PinholeCamera& camera, std::size_t points) {
  ObjectImage result;
  InverseDepthImage& image = result.image;
  image.width = crop.right - crop.left + 1;
  image.height = crop.bottom - crop.top + 1;
  image.fx = camera.fx;
  image.fy = camera.fy;
  image.cx = camera.cx - crop.left;
  image.cy = camera.cy - crop.top;
  const auto pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  image.w.assign(pixels, 0.0F);
  image.object.assign(pixels, 0);
  result.pixel_of_point.assign(points, ObjectImage::kNone);
  return result;
}

ObjectImage cutOut(const Measurement& z, std::span<const Candidate> candidates) {
  const auto& whole = *z.image;
  const auto width = static_cast<std::uint32_t>(whole.camera.width);
  Crop crop;
  for (const auto& c : candidates) {
    const auto pixel = z.pixel_of_point[c.point];
    crop.extend(static_cast<int>(pixel % width), static_cast<int>(pixel / width));
  }
  crop.grow(whole.camera.width, whole.camera.height);
  ObjectImage result = emptyImage(crop, whole.camera, z.world_points.size());
  // Points mostly come row by row, but need not: a division only where the row is another one.
  std::uint32_t row = 0;
  for (std::size_t i = 0; i < z.pixel_of_point.size(); ++i) {
    if (z.pixel_of_point[i] - row * width >= width) row = z.pixel_of_point[i] / width;
    const int u = static_cast<int>(z.pixel_of_point[i] - row * width);
    const int v = static_cast<int>(row);
    if (u < crop.left || u > crop.right || v < crop.top || v > crop.bottom) continue;
    const auto pixel = static_cast<std::uint32_t>((v - crop.top) * result.image.width + u - crop.left);
    result.pixel_of_point[i] = pixel;
    result.image.w[pixel] = 1.0F / whole.depth[z.pixel_of_point[i]];
  }
  return result;
}

/// Of points that share a pixel the nearest counts, and those that it does not hide.
ObjectImage project(const Measurement& z, std::span<const Candidate> candidates) {
  constexpr double kSameSurface = 0.02;  // 1/m
  const VirtualCamera camera(z, candidates);
  Crop crop;
  for (const auto& c : candidates) {
    if (const auto at = camera.project(z.world_points[c.point])) crop.extend(at->u, at->v);
  }
  if (crop.right < 0) crop = {0, 0, 0, 0};
  crop.grow(camera.pinhole().width, camera.pinhole().height);
  ObjectImage result = emptyImage(crop, camera.pinhole(), z.world_points.size());
  std::vector<float> w(z.world_points.size(), 0.0F);
  for (std::size_t i = 0; i < w.size(); ++i) {
    const auto at = camera.project(z.world_points[i]);
    if (!at || at->u < crop.left || at->u > crop.right || at->v < crop.top || at->v > crop.bottom) continue;
    const auto pixel =
        static_cast<std::uint32_t>((at->v - crop.top) * result.image.width + at->u - crop.left);
    result.pixel_of_point[i] = pixel;
    w[i] = static_cast<float>(at->w);
    result.image.w[pixel] = std::max(result.image.w[pixel], w[i]);
  }
  for (std::size_t i = 0; i < w.size(); ++i) {
    auto& pixel = result.pixel_of_point[i];
    if (pixel != ObjectImage::kNone && result.image.w[pixel] - w[i] > static_cast<float>(kSameSurface)) {
      pixel = ObjectImage::kNone;
    }
  }
  return result;
}

}  // namespace

ObjectImage objectImage(const Measurement& z, std::span<const Candidate> candidates) {
  ObjectImage result = z.image ? cutOut(z, candidates) : project(z, candidates);
  for (const auto& c : candidates) {
    const auto pixel = result.pixel_of_point[c.point];
    if (pixel != ObjectImage::kNone) result.image.object[pixel] = 1;
  }
  return result;
}

}  // namespace hoctomap
