// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "hoctomap/mapping/SeamVotes.h"

namespace hoctomap {

/// A cell in one word: cells more than 2^20 cells (15 km) apart share words.
inline std::uint64_t cellKey(const SeamVotes::Cell& cell) {
  const auto part = [](std::int32_t i) { return static_cast<std::uint64_t>(i + (1 << 20)) & 0x1FFFFFU; };
  return part(cell.x) << 42U | part(cell.y) << 21U | part(cell.z);
}

}  // namespace hoctomap
