// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/tabletop/LabelImage.h"

namespace hoctomap {

std::vector<std::uint16_t> labelPoints(const Measurement& z, std::span<const Segment> segments) {
  std::vector<std::uint16_t> values(z.world_points.size(), label_value::background);
  std::uint32_t next_table = label_value::first_table;
  std::uint32_t next_object = label_value::first_object;
  for (const auto& segment : segments) {
    std::uint32_t value = label_value::background;
    if (segment.structure == Structure::plane && next_table < label_value::first_object) value = next_table++;
    if (segment.structure == Structure::cluster && next_object <= 0xFFFFU) value = next_object++;
    for (const auto i : segment.points) values[i] = static_cast<std::uint16_t>(value);
  }
  return values;
}

std::vector<std::uint16_t> labelImage(const Measurement& z, std::span<const Segment> segments) {
  if (!z.image) return {};
  std::vector<std::uint16_t> pixels(z.image->depth.size(), label_value::no_return);
  const auto values = labelPoints(z, segments);
  for (std::size_t i = 0; i < values.size(); ++i) pixels[z.pixel_of_point[i]] = values[i];
  return pixels;
}

}  // namespace hoctomap
