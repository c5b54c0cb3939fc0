// SPDX-License-Identifier: BSD-3-Clause
#include "ScanSight.h"

#include <cmath>

namespace hoctomap {

ScanSight::ScanSight(const Measurement& z, double near, const RangeNoise& noise)
    : has_image_(z.image.has_value()), near_(near), noise_(noise), view_(z) {}

Sight ScanSight::operator()(const Eigen::Vector3f& world_point) const {
  const auto pixel = view_.project(world_point);
  if (!pixel) return Sight::hidden;
  const float measured =
      view_.measured(static_cast<int>(std::lround(pixel->u)), static_cast<int>(std::lround(pixel->v)));
  const auto tolerance = static_cast<float>(near_ + 3.0 * noise_.sigma(static_cast<double>(pixel->range)));
  if (measured == 0.0F || measured < pixel->range - tolerance) return Sight::hidden;
  return measured > pixel->range + tolerance ? Sight::seen_through : Sight::surface;
}

}  // namespace hoctomap
