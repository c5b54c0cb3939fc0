// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RayBatch.h"

namespace hoctomap::engine {

/// As RayMarker's marking of `kWideLanes` rays, with the instructions of AVX-512. Those of a ray's cells that
/// lie in one word after the other are gathered before they are written: a quarter of the writes is left.
bool markWide(const RayBatch& batch, const std::uint16_t* rays, BlockBits* words, std::uint8_t* pages);

}  // namespace hoctomap::engine
