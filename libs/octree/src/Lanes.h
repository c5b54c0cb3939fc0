// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "MortonCode.h"

namespace hoctomap::engine {

/// Several rays at a time. The compiler's vector types work on every processor, with the instructions that a
/// function is compiled for, and every lane has the bits that scalar code would give it.
template <std::size_t lanes>
struct Lanes {
  using Doubles __attribute__((vector_size(lanes * sizeof(double)))) = double;
  using Codes __attribute__((vector_size(lanes * sizeof(Code)))) = Code;
  using Floats __attribute__((vector_size(lanes * sizeof(float)))) = float;
  using Mask __attribute__((vector_size(lanes * sizeof(Code)))) = Code;  ///< all bits, or none
};

/// The sets of instructions that the engine is compiled for. They differ in speed only.
enum class InstructionSet : std::uint8_t { baseline, avx2, avx512 };

// Rays that are marked at the same time: with AVX-512 in two groups of eight.
inline constexpr std::size_t kNarrowLanes = 4;
inline constexpr std::size_t kWideLanes = 16;

#if defined(__x86_64__)
#define HOCTOMAP_TARGET_AVX2 [[gnu::target("avx2,bmi2")]]
#define HOCTOMAP_TARGET_AVX512 [[gnu::target("avx512f,avx512dq,avx512vl,avx2,bmi2,popcnt")]]
/// The best set of this processor.
inline InstructionSet bestInstructionSet() {
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("bmi2")) return InstructionSet::baseline;
  const bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                    __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("popcnt");
  return wide ? InstructionSet::avx512 : InstructionSet::avx2;
}
#else
#define HOCTOMAP_TARGET_AVX2
#define HOCTOMAP_TARGET_AVX512
inline InstructionSet bestInstructionSet() {
  return InstructionSet::baseline;
}
#endif

}  // namespace hoctomap::engine
