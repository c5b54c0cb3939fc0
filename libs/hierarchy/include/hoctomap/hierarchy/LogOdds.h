// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace hoctomap {

[[nodiscard]] inline double logOdds(double probability) {
  return std::log(probability / (1.0 - probability));
}
[[nodiscard]] inline double probability(double log_odds) {
  return 1.0 / (1.0 + std::exp(-log_odds));
}

}  // namespace hoctomap
