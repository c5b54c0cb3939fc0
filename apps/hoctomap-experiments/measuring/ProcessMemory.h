// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace hoctomap {

/// Bytes of main memory that programs may still take without swapping.
[[nodiscard]] std::uint64_t availableMemory();

/// How far the resident memory of this process grows above what it has now.
class MemoryPeak {
 public:
  /// Gives freed memory back to the system first, so that reuse of it counts as growth.
  MemoryPeak();
  [[nodiscard]] std::uint64_t before() const { return before_; }
  /// Bytes above `before` at the highest point since the construction.
  [[nodiscard]] std::uint64_t growth() const;

 private:
  std::uint64_t before_;
};

/// What one measurement may use; 0 is no limit. Beyond it an allocation fails, or the process ends by
/// SIGXCPU, instead of the machine swapping or the experiment never ending.
struct ProcessLimits {
  std::uint64_t memory_bytes = 0;
  std::uint64_t cpu_seconds = 0;
};

/// Limits this process, for good.
void limitThisProcess(const ProcessLimits& limits);

}  // namespace hoctomap
