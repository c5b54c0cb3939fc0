// SPDX-License-Identifier: BSD-3-Clause
#include "RangeBuffer.h"

#include <algorithm>
#include <cmath>

namespace hoctomap {

namespace {

/// Halves away from zero. std::lround is a call of the library, and voxels are many.
int nearestInt(float x) {
  return static_cast<int>(x < 0.0F ? x - 0.5F : x + 0.5F);
}

}  // namespace

template <typename Visit>
void RangeBuffer::forPixels(const RangeView::Pixel& center, float focal, float size, const Visit& visit) {
  const int half = static_cast<int>(std::ceil(0.5F * focal * size / center.range));
  // Far outside pixel coordinates overflow an int; such a voxel covers nothing here.
  if (std::abs(center.u) > 1e6F || std::abs(center.v) > 1e6F) return;
  const int u = nearestInt(center.u);
  const int v = nearestInt(center.v);
  const int u_first = std::max(u0_, u - half);
  const int u_last = std::min(u1(), u + half);
  const int v_first = std::max(v0_, v - half);
  const int v_last = std::min(v1(), v + half);
  for (int y = v_first; y <= v_last; ++y) {
    float* row = range_.data() + static_cast<std::ptrdiff_t>(y - v0_) * width_ - u0_;
    for (int x = u_first; x <= u_last; ++x) visit(x, y, row[x]);
  }
}

void RangeBuffer::splat(const RangeView::Pixel& center, float focal, float size) {
  forPixels(center, focal, size, [&](int, int, float& range) { range = std::min(range, center.range); });
}

void RangeBuffer::splatBehind(const RangeBuffer& front, const RangeView::Pixel& center, float focal,
                              float size, bool beside) {
  const float nearest = center.range - 0.5F * size;
  forPixels(center, focal, size, [&](int x, int y, float& range) {
    const float before = front.at(x, y);
    if (before == kEmpty ? beside : nearest >= before) range = std::min(range, center.range);
  });
}

void RangeBuffer::overlay(const RangeBuffer& other) {
  for (int v = std::max(v0_, other.v0_); v <= std::min(v1(), other.v1()); ++v) {
    for (int u = std::max(u0_, other.u0_); u <= std::min(u1(), other.u1()); ++u) {
      float& range = range_[static_cast<std::size_t>(v - v0_) * static_cast<std::size_t>(width_) +
                            static_cast<std::size_t>(u - u0_)];
      range = std::min(range, other.at(u, v));
    }
  }
}

}  // namespace hoctomap
