// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace hoctomap {

/// From its construction on, SIGINT and SIGTERM ask the program to stop after the current scan. A second
/// signal ends it at once, which is safe: what is committed stays committed. Work that takes longer than 1.5
/// s after the first one, less for a large process, is given up in the same way, with the exit code of a stop
/// (docs/decisions/0046).
class StopSignal {
 public:
  enum class LongWork {
    given_up,    ///< the program commits from time to time
    waited_for,  ///< it commits at its end only
  };
  explicit StopSignal(LongWork long_work);
  /// The signal that asked, 0 if none did.
  [[nodiscard]] static int requested();
};

}  // namespace hoctomap
