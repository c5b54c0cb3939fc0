// SPDX-License-Identifier: BSD-3-Clause
#include "RangeBuffer.h"

#include <algorithm>
#include <cmath>

namespace hoctomap {

void RangeBuffer::splat(const RangeView::Pixel& center, float focal, float size) {
  const float half = std::ceil(0.5F * focal * size / center.range);
  // Far outside pixel coordinates overflow an int; such a voxel covers nothing here.
  if (std::abs(center.u) > 1e6F || std::abs(center.v) > 1e6F) return;
  const int u_first = std::max(u0_, static_cast<int>(std::lround(center.u - half)));
  const int u_last = std::min(u1(), static_cast<int>(std::lround(center.u + half)));
  const int v_first = std::max(v0_, static_cast<int>(std::lround(center.v - half)));
  const int v_last = std::min(v1(), static_cast<int>(std::lround(center.v + half)));
  for (int v = v_first; v <= v_last; ++v) {
    float* row = range_.data() + static_cast<std::ptrdiff_t>(v - v0_) * width_ - u0_;
    for (int u = u_first; u <= u_last; ++u) row[u] = std::min(row[u], center.range);
  }
}

}  // namespace hoctomap
