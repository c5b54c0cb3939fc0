// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstring>

#include "Lanes.h"

// Small functions of several lanes, always inlined: so they have the instructions of the function that they
// are used in. `V` holds doubles, `M` is a mask, the type of a comparison.
#define HOCTOMAP_INLINE [[gnu::always_inline]] inline

namespace hoctomap::engine {

template <class V, class T>
HOCTOMAP_INLINE void load(V& v, const T* from) {
  std::memcpy(static_cast<void*>(&v), from, sizeof v);
}
template <class V, class T>
HOCTOMAP_INLINE void store(const V& v, T* to) {
  std::memcpy(to, &v, sizeof v);
}
template <class M, class V>
HOCTOMAP_INLINE V either(const M& mask, const V& a, const V& b) {
  return mask ? a : b;
}
template <class V>
HOCTOMAP_INLINE V lesser(const V& a, const V& b) {
  return either(a < b, a, b);
}
template <class V>
HOCTOMAP_INLINE V greater(const V& a, const V& b) {
  return either(a > b, a, b);
}
template <class V, class F>
HOCTOMAP_INLINE V toDoubles(const F& a) {
  return __builtin_convertvector(a, V);
}
template <class F, class V>
HOCTOMAP_INLINE F toFloats(const V& a) {
  return __builtin_convertvector(a, F);
}
/// Sets the first so many lanes of a mask, which is empty.
template <class M>
HOCTOMAP_INLINE void setFirst(M& mask, std::size_t count) {
  for (std::size_t lane = 0; lane < sizeof(M) / sizeof(Code); ++lane) mask[lane] = lane < count ? -1 : 0;
}
/// All bits where the mask is set.
template <class M>
HOCTOMAP_INLINE M codesOf(const M& mask) {
  return mask;
}
template <class V>
HOCTOMAP_INLINE V magnitude(const V& a) {
  using M = decltype(a < a);
  return reinterpret_cast<V>(reinterpret_cast<M>(a) & 0x7FFF'FFFF'FFFF'FFFFLL);
}
template <class M>
HOCTOMAP_INLINE bool anyOf(const M& mask) {
  Code any = 0;
  for (std::size_t lane = 0; lane < sizeof(M) / sizeof(Code); ++lane) any |= mask[lane];
  return any != 0;
}

// Added to a number below 2^51 in magnitude, it leaves no places after the point.
inline constexpr double kWholeShift = 6755399441055744.0;  // 1.5 * 2^52

/// Rounded down, for numbers below 2^51 in magnitude.
template <class V>
HOCTOMAP_INLINE V floorOf(const V& x) {
  const V nearest = (x + kWholeShift) - kWholeShift;
  return either(nearest > x, nearest - 1.0, nearest);
}
/// Whole numbers below 2^51 in magnitude as integers.
template <class V>
HOCTOMAP_INLINE auto toCodes(const V& x) {
  using M = decltype(x < x);
  const V shifted = x + kWholeShift;
  const V zero = V{} + kWholeShift;
  return reinterpret_cast<M>(shifted) - reinterpret_cast<M>(zero);
}
template <class V>
HOCTOMAP_INLINE V rootOf(const V& x) {
  V root;
  for (std::size_t lane = 0; lane < sizeof(V) / sizeof(double); ++lane) root[lane] = std::sqrt(x[lane]);
  return root;
}

/// As `dilate`, lane by lane.
template <class M>
HOCTOMAP_INLINE M dilateLanes(M x) {
  x = (x | x << 32) & static_cast<Code>(0xFFFF'0000'0000'FFFFULL);
  x = (x | x << 16) & 0x00FF'0000'FF00'00FFLL;
  x = (x | x << 8) & static_cast<Code>(0xF00F'00F0'0F00'F00FULL);
  x = (x | x << 4) & 0x30C3'0C30'C30C'30C3LL;
  x = (x | x << 2) & static_cast<Code>(0x9249'2492'4924'9249ULL);
  return x;
}

}  // namespace hoctomap::engine
