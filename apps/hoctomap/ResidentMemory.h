// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace hoctomap {

/// What this process has in memory, in bytes. (MRPT's `getMemoryUsage` says what it has asked for.)
struct ResidentMemory {
  std::size_t bytes = 0;
  std::size_t peak = 0;  ///< the most so far
};
[[nodiscard]] ResidentMemory residentMemory();

}  // namespace hoctomap
