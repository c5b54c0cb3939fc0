// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "hoctomap/mrpt_io/LogReader.h"

namespace hoctomap {

/// Reads logs into a stream, with what goes wrong as its last message: what a reader does between its
/// confinement and its end. Crashes are told, too.
/// @param stream  file descriptor to write to
/// @returns the exit code: 0, 5 if nobody reads any more, 6 without memory, else that of the error
[[nodiscard]] int streamLog(const LogReadOptions& options, int stream);

}  // namespace hoctomap
