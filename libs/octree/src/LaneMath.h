// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "Lanes.h"

// Small functions of four lanes, always inlined: so they have the instructions of the function that they are
// used in.
#define HOCTOMAP_INLINE [[gnu::always_inline]] inline

namespace hoctomap::engine {

HOCTOMAP_INLINE Doubles toDoubles(const Floats& v) {
  return __builtin_convertvector(v, Doubles);
}
HOCTOMAP_INLINE Doubles either(const Codes& mask, const Doubles& a, const Doubles& b) {
  return mask ? a : b;
}
HOCTOMAP_INLINE Doubles lesser(const Doubles& a, const Doubles& b) {
  return a < b ? a : b;
}
HOCTOMAP_INLINE Doubles greater(const Doubles& a, const Doubles& b) {
  return a > b ? a : b;
}
HOCTOMAP_INLINE Doubles magnitude(const Doubles& a) {
  return reinterpret_cast<Doubles>(reinterpret_cast<Codes>(a) & 0x7FFF'FFFF'FFFF'FFFFLL);
}
HOCTOMAP_INLINE bool anyOf(const Codes& mask) {
  return (mask[0] | mask[1] | mask[2] | mask[3]) != 0;
}
/// Rounded down, for numbers that fit an int.
HOCTOMAP_INLINE Doubles floorOf(const Doubles& x) {
  const Doubles truncated = __builtin_convertvector(__builtin_convertvector(x, Ints), Doubles);
  return truncated > x ? truncated - 1.0 : truncated;
}
HOCTOMAP_INLINE Codes toCodes(const Doubles& x) {
  return __builtin_convertvector(__builtin_convertvector(x, Ints), Codes);
}
HOCTOMAP_INLINE Doubles rootOf(const Doubles& x) {
  Doubles root;
  for (std::size_t lane = 0; lane < kLanes; ++lane) root[lane] = std::sqrt(x[lane]);
  return root;
}

/// As `dilate`, four at a time.
HOCTOMAP_INLINE Codes dilateLanes(Codes x) {
  x = (x | x << 32) & static_cast<Code>(0xFFFF'0000'0000'FFFFULL);
  x = (x | x << 16) & 0x00FF'0000'FF00'00FFLL;
  x = (x | x << 8) & static_cast<Code>(0xF00F'00F0'0F00'F00FULL);
  x = (x | x << 4) & 0x30C3'0C30'C30C'30C3LL;
  x = (x | x << 2) & static_cast<Code>(0x9249'2492'4924'9249ULL);
  return x;
}

/// The power of two at or below a positive number.
HOCTOMAP_INLINE Doubles binadeOf(const Doubles& x) {
  return reinterpret_cast<Doubles>(reinterpret_cast<Codes>(x) & 0x7FF0'0000'0000'0000LL);
}

/// To the next whole number, for numbers below 2^51 in magnitude.
HOCTOMAP_INLINE Doubles nearestOf(const Doubles& x) {
  constexpr double kShift =
      6755399441055744.0;  // 1.5 * 2^52: numbers of this size have no places after the point
  return (x + kShift) - kShift;
}

/// A part of `addRepeatedly`, for four rays: to the end of the binade, or some steps where one begins.
HOCTOMAP_INLINE void addSome(Doubles& t, const Doubles& delta, const Doubles& per_step, Doubles& count) {
  const Doubles a = t + delta;
  const Doubles b = a + delta;
  const Doubles c = b + delta;
  const Doubles limit = 2.0 * binadeOf(b);
  const Codes steady = (a > 0.0) & (c < limit) & (binadeOf(a) == binadeOf(b)) & (count > 3.0);
  // At least half a step below the limit: far more than the error of the product.
  const Doubles more = nearestOf(lesser(count - 2.0, (limit - b) * per_step - 1.0));
  const Codes two = count > 1.0;
  t = either(two, either(steady, b + more * (c - b), b), t);
  count -= either(two, either(steady, more, Doubles{}) + 2.0, Doubles{});
  for (int i = 0; i < 2; ++i) {  // into the next binade
    const Codes one = count > 0.0;
    t = either(one, t + delta, t);
    count -= either(one, Doubles{} + 1.0, Doubles{});
  }
}

/// As `addRepeatedly`, for four rays and three axes at a time: the axes' chains of operations overlap.
HOCTOMAP_INLINE void addRepeatedlyLanes(Doubles t[3], const Doubles delta[3], const Doubles count[3]) {
  Doubles t0 = t[0], t1 = t[1], t2 = t[2];
  Doubles n0 = count[0], n1 = count[1], n2 = count[2];
  const Doubles per0 = 1.0 / delta[0], per1 = 1.0 / delta[1], per2 = 1.0 / delta[2];
  while (anyOf((n0 > 0.0) | (n1 > 0.0) | (n2 > 0.0))) {
    addSome(t0, delta[0], per0, n0);
    addSome(t1, delta[1], per1, n1);
    addSome(t2, delta[2], per2, n2);
  }
  t[0] = t0;
  t[1] = t1;
  t[2] = t2;
}

}  // namespace hoctomap::engine
