// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "hoctomap/io/LogReadOptions.h"
#include "hoctomap/mrpt_io/ReadProgress.h"

namespace hoctomap {

/// What a log holds and whether it can be built, for people and for programs.
struct LogInfo {
  std::string text;      ///< lines for a terminal
  std::string json;      ///< one object, indented
  bool damaged = false;  ///< the log is not whole; `text` and `json` tell of what stands before the damage
};

/// Reads the first log of `options` once; its pose options are taken into account for "can it be built".
/// @throws InputError if it cannot be opened, LimitError.
[[nodiscard]] LogInfo describeLog(const LogReadOptions& options, ReadProgress& progress);

}  // namespace hoctomap
