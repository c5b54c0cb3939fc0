// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace hoctomap {

/// From its construction on, SIGINT and SIGTERM ask the program to stop after the current scan. A second
/// signal ends it at once, which is safe: what is committed stays committed.
class StopSignal {
 public:
  StopSignal();
  /// The signal that asked, 0 if none did.
  [[nodiscard]] static int requested();
};

}  // namespace hoctomap
