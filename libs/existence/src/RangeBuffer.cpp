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

void RangeBuffer::splat(const RangeView::Pixel& center, float focal, float size) {
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
    for (int x = u_first; x <= u_last; ++x) row[x] = std::min(row[x], center.range);
  }
}

}  // namespace hoctomap
