// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "hoctomap/hierarchy/Label.h"

namespace hoctomap {

/// Fig. 3 of the paper: objects cyan, tables magenta, the rest yellow; labels of one's own green.
inline std::array<std::uint8_t, 3> colourOf(const Label& label) {
  if (label == labels::object) return {0, 190, 205};
  if (label == labels::table) return {205, 40, 165};
  if (label == labels::background) return {235, 205, 70};
  return {120, 180, 90};
}

}  // namespace hoctomap
