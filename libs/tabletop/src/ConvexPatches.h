// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "InverseDepth.h"

namespace hoctomap {

/// Takes the object pixels of an image apart into things: smooth patches that join convexly make one thing,
/// concave creases and steps in depth part things, and what is hollow goes to the thing it is the inside of.
/// Returns the number of the thing of every pixel, -1 where there is none.
///
/// @param range_noise 1/m, standard deviation of the inverse range.
[[nodiscard]] std::vector<std::int32_t> convexThings(const InverseDepthImage& image, double range_noise);

}  // namespace hoctomap
