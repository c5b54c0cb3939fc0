// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RayBatch.h"

namespace hoctomap::engine {

/// Bits of the longest code that `markFixed` takes: cubes of 1024^3 voxels.
inline constexpr unsigned kFixedCodeBits = 30;

/// Rays that it marks at a time.
inline constexpr std::size_t kFixedLanes = 32;

/// As `markWide`, with times as fixed-point numbers: sixteen rays at the cost of eight. A ray is walked in
/// stretches, each cut into 2^30 units of time, so that the times are off by half a unit for each crossing.
/// Where two crossings come so close that their order is not certain (some rays in a thousand) the answer is
/// false, and `markWide` is to be called: cells that are marked already do no harm. Codes have at most
/// `kFixedCodeBits`.
bool markFixed(const RayBatch& batch, const std::uint16_t* rays, BlockBits* words, std::uint8_t* pages);

}  // namespace hoctomap::engine
