// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "ResidentMemory.h"

namespace hoctomap {

/// The memory that a run may take. Scans are refused before they would exceed it, so that the machine does
/// not swap and the map on disk stays as it is; what a single scan takes beyond all expectation fails as an
/// allocation.
class MemoryBudget {
 public:
  /// @param megabytes  of resident memory; negative: nine tenths of the machine's
  explicit MemoryBudget(double megabytes);

  /// Before a scan is integrated: is there room for as much more as the hungriest one so far has taken?
  /// @throws LimitError if not.
  void requireRoom(std::uint64_t scan);

 private:
  std::size_t budget_;     ///< bytes
  ResidentMemory before_;  ///< when a scan was last asked about
  std::size_t largest_growth_ = 0;
};

}  // namespace hoctomap
