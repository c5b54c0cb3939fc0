// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>

#include "hoctomap/io/ScanStream.h"

namespace hoctomap {

/// Where a reader is, for whoever must say it when the process dies under a foreign log: lock-free, so that a
/// signal handler may look.
struct ReadProgress {
  std::atomic<std::uint32_t> log{0};
  std::atomic<std::uint64_t> object{0};
  std::atomic<std::uint64_t> offset{0};
  std::atomic<std::uint64_t> read{0};  ///< bytes of the log so far, to within a buffer
  std::atomic<bool> in_object{false};  ///< MRPT is at work on the object

  void set(const StreamPosition& position) {
    log = position.log;
    object = position.object;
    offset = position.offset;
  }
  [[nodiscard]] StreamPosition get() const { return {log, object, offset}; }
};

static_assert(std::atomic<std::uint64_t>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

}  // namespace hoctomap
