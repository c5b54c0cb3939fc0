// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hoctomap/mapping/Segmentation.h"

namespace hoctomap {

/// Values of the label images of `hoctomap segment`.
namespace label_value {
inline constexpr std::uint16_t no_return = 0;
inline constexpr std::uint16_t background = 1;
inline constexpr std::uint16_t first_table = 10;    ///< 10 + i, i-th plane; at most 90
inline constexpr std::uint16_t first_object = 100;  ///< 100 + j, j-th cluster
}  // namespace label_value

/// The value of every point of the measurement, in the order of its cloud. Planes beyond the 90th and
/// clusters beyond the 65436th are given as background.
[[nodiscard]] std::vector<std::uint16_t> labelPoints(const Measurement& z, std::span<const Segment> segments);

/// The value of every pixel, row-major; empty if the measurement has no image.
[[nodiscard]] std::vector<std::uint16_t> labelImage(const Measurement& z, std::span<const Segment> segments);

}  // namespace hoctomap
