// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "MortonCode.h"

namespace hoctomap::engine {

/// Four rays at a time. The compiler's vector types work on every processor, with the instructions that a
/// function is compiled for, and every lane has the bits that scalar code would give it.
inline constexpr std::size_t kLanes = 4;

using Doubles = double __attribute__((vector_size(kLanes * sizeof(double))));
using Codes = Code __attribute__((vector_size(kLanes * sizeof(Code))));  ///< also the type of comparisons
using Floats = float __attribute__((vector_size(kLanes * sizeof(float))));
using Ints = std::int32_t __attribute__((vector_size(kLanes * sizeof(std::int32_t))));

/// Runs a function template compiled twice: for every processor of the architecture, and for AVX2.
#if defined(__x86_64__)
#define HOCTOMAP_TARGET_AVX2 [[gnu::target("avx2,bmi2")]]
inline bool hasAvx2() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2");
}
#else
#define HOCTOMAP_TARGET_AVX2
inline bool hasAvx2() {
  return false;
}
#endif

}  // namespace hoctomap::engine
