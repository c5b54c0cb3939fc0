// SPDX-License-Identifier: BSD-3-Clause
#include "WideRayBatch.h"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#if defined(__x86_64__)

#include <immintrin.h>

// From here on everything is compiled for AVX-512: our own templates, which no other source uses with these
// types.
#pragma GCC target("avx512f,avx512dq,avx512vl,avx2,bmi2,popcnt")
#include "RayPreparation.h"
#include "WideLanes.h"

namespace hoctomap::engine {

void prepareWide(const RayFan& fan, const RayEnds& ends, std::size_t at, RayBatch& batch) {
  prepare<WideLanes>(fan, ends, at, batch);
}

}  // namespace hoctomap::engine

#else

namespace hoctomap::engine {

void prepareWide(const RayFan&, const RayEnds&, std::size_t, RayBatch&) {
  std::abort();  // no processor of this architecture has the instructions
}

}  // namespace hoctomap::engine

#endif
