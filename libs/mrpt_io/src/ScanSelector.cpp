// SPDX-License-Identifier: BSD-3-Clause
#include "ScanSelector.h"

#include <algorithm>

namespace hoctomap {

bool ScanSelector::take(const std::string& sensor) {
  const std::uint64_t scan = next_scan_++;
  if (scan < options_.start) return false;
  const auto& wanted = options_.sensors;
  if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), sensor) == wanted.end()) return false;
  return candidates_++ % options_.every == 0;
}

}  // namespace hoctomap
