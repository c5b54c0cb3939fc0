// SPDX-License-Identifier: BSD-3-Clause
#include "ScanSelector.h"

#include <algorithm>

namespace hoctomap {

bool ScanSelector::take(const std::string& sensor) {
  const std::uint64_t scan = next_scan_++;
  if (scan < options_.start || (options_.end && scan >= *options_.end)) return false;
  const auto& wanted = options_.sensors;
  if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), sensor) == wanted.end()) return false;
  const std::uint64_t candidate = candidates_++;
  return candidate % options_.every == 0 && sampled(candidate / options_.every);
}

/// The p-th of P pairs begins at floor(p * chosen / P).
bool ScanSelector::sampled(std::uint64_t number) const {
  const std::uint64_t pairs = options_.sample_pairs;
  if (pairs == 0 || chosen_ <= 2 * pairs) return true;
  const auto begins = [&](std::uint64_t at) {
    const std::uint64_t pair =
        (at * pairs + chosen_ - 1) / chosen_;  // the first that begins at `at` or later
    return pair < pairs && pair * chosen_ / pairs == at;
  };
  return begins(number) || (number > 0 && begins(number - 1));
}

}  // namespace hoctomap
