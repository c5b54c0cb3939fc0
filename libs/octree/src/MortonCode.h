// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "VoxelGrid.h"

namespace hoctomap::engine {

/// Morton codes of voxels: the bits of the three keys interleaved, x lowest, so that the order of the codes
/// is the order of an octree. Three bits a level: a code without its last 3n bits names the octree node n
/// levels up.
///
/// The bits of one axis, spread to every third place ("dilated"), can be stepped without taking the code
/// apart: with all other places set, the carry of adding 1 runs over them.
using Code = std::int64_t;

/// Places of x, y and z in the code of a 16-bit key.
inline constexpr std::array<Code, 3> kAxisMask{0x2492'4924'9249, 0x4924'9249'2492, 0x9249'2492'4924};

/// The same over the whole word.
inline constexpr std::array<Code, 3> kAxisPlaces{static_cast<Code>(0x9249'2492'4924'9249),
                                                 0x2492'4924'9249'2492, 0x4924'9249'2492'4924};

/// The 16 bits of a key at every third place, from place 0.
constexpr Code dilate(int key) {
  auto x = static_cast<std::uint64_t>(key);
  x = (x | x << 32U) & 0xFFFF'0000'0000'FFFFULL;
  x = (x | x << 16U) & 0x00FF'0000'FF00'00FFULL;
  x = (x | x << 8U) & 0xF00F'00F0'0F00'F00FULL;
  x = (x | x << 4U) & 0x30C3'0C30'C30C'30C3ULL;
  x = (x | x << 2U) & 0x9249'2492'4924'9249ULL;
  return static_cast<Code>(x);
}

/// The inverse of `dilate`, for the bits at places 0, 3, 6 ...
constexpr int compact(Code code) {
  auto x = static_cast<std::uint64_t>(code) & 0x9249'2492'4924'9249ULL;
  x = (x | x >> 2U) & 0x30C3'0C30'C30C'30C3ULL;
  x = (x | x >> 4U) & 0xF00F'00F0'0F00'F00FULL;
  x = (x | x >> 8U) & 0x00FF'0000'FF00'00FFULL;
  x = (x | x >> 16U) & 0xFFFF'0000'0000'FFFFULL;
  x = (x | x >> 32U) & 0xFFFFULL;
  return static_cast<int>(x);
}

constexpr Code codeOf(const Key& key) {
  return dilate(key[0]) | dilate(key[1]) << 1U | dilate(key[2]) << 2U;
}

constexpr Key keyOf(Code code) {
  return {compact(code), compact(code >> 1U), compact(code >> 2U)};
}

}  // namespace hoctomap::engine
