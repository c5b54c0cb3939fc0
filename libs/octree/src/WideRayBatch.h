// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RayBatch.h"

namespace hoctomap::engine {

inline constexpr std::size_t kWidePreparation = 8;

/// See `Preparation`: with the instructions of AVX-512.
void prepareWide(const RayFan& fan, const RayEnds& ends, std::size_t at, RayBatch& batch);

}  // namespace hoctomap::engine
