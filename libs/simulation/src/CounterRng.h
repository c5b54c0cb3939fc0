// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace hoctomap {

/// Random numbers without state: the n-th draw of a pixel is a hash of (seed, scan, pixel, n), so that the
/// order in which pixels are computed does not matter. The hash is the finaliser of SplitMix64 (Steele et al.
/// 2014) applied to each part in turn.
class CounterRng {
 public:
  CounterRng(std::uint64_t seed, std::uint64_t scan) : key_(mix(mix(seed) ^ scan)) {}

  /// In [0, 1).
  [[nodiscard]] double uniform(std::uint64_t pixel, std::uint64_t n) const {
    constexpr double kUnit = 1.0 / 9007199254740992.0;  // 2^-53
    return static_cast<double>(mix(mix(key_ ^ pixel) ^ n) >> 11U) * kUnit;
  }

  /// Standard normal (Box-Muller); uses draws n and n + 1.
  [[nodiscard]] double normal(std::uint64_t pixel, std::uint64_t n) const {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(pixel, n)));
    return radius * std::cos(2.0 * std::numbers::pi * uniform(pixel, n + 1));
  }

 private:
  static std::uint64_t mix(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31U);
  }

  std::uint64_t key_;
};

}  // namespace hoctomap
