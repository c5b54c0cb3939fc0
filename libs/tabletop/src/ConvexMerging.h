// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "PatchGraph.h"

namespace hoctomap {

/// The region of every patch, numbered from 0.
struct PatchRegions {
  std::vector<std::int32_t> of_patch;
  std::int32_t count = 0;
};

/// Joins patches to regions, always the two whose common border says least that they are two, on the average
/// over all of it: no single path of convex borders leaks from one object into the next. Regions of less than
/// `fragment` pixels go at last to the neighbour that they are least parted from.
[[nodiscard]] PatchRegions mergeConvex(const PatchGraph& graph, double fragment);

}  // namespace hoctomap
