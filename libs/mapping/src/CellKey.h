// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "hoctomap/mapping/SeamVotes.h"

namespace hoctomap {

/// A cell in one word: cells more than 2^20 cells (15 km) apart share words.
inline std::uint64_t cellKey(const SeamVotes::Cell& cell) {
  const auto part = [](std::int32_t i) { return static_cast<std::uint64_t>(i + (1 << 20)) & 0x1FFFFFU; };
  return part(cell.x) << 42U | part(cell.y) << 21U | part(cell.z);
}

/// Calls `visit(i, j)` for all cells j that lie `offset` from a cell i of `cells`, which are in order: so are
/// these, and one walk finds them.
template <typename Visit>
void forCellPairs(std::span<const SeamVotes::Cell> cells, const SeamVotes::Cell& offset, const Visit& visit) {
  std::uint32_t j = 0;
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    const SeamVotes::Cell other{cells[i].x + offset.x, cells[i].y + offset.y, cells[i].z + offset.z};
    while (j < cells.size() && cells[j] < other) ++j;
    if (j == cells.size()) return;
    if (cells[j] == other) visit(i, j);
  }
}

}  // namespace hoctomap
