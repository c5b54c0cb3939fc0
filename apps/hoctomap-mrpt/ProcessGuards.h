// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "hoctomap/io/LogReadOptions.h"
#include "hoctomap/mrpt_io/ReadProgress.h"

namespace hoctomap {

/// Ends this process when the one that started it ends.
void dieWithParent();

/// Limits on memory, CPU time (by the size of the logs), core files; and, if stdout is no regular file, on
/// writing files at all. They hold until the process ends.
void limitProcess(const LogReadOptions& options);

/// More than 10^7 points of three floats: no single array of an honest log is larger.
inline constexpr std::size_t kLargestArray = std::size_t{128} << 20;

/// Single allocations beyond `bytes` fail with std::bad_alloc from now on, also those of MRPT: it takes
/// counts from a log as they are and fills the memory with zeros before it notices that nothing follows.
void setAllocationCeiling(std::size_t bytes);

/// How a process that dies under a log says so.
enum class LastWord { stream_message, line_of_text };

/// A crash under a foreign log becomes an error on `fd` and exit code 3, or 6 if CPU time is used up: that of
/// the process, or that of one object, 5 s and a second more for every 4 MiB that it has given. The clock
/// runs while MRPT reads: what it computes from a number in the log has no bound.
void reportCrashes(LastWord kind, int fd, const std::vector<std::filesystem::path>& logs,
                   const ReadProgress& progress);

/// Moves stdout to a descriptor of its own and returns it; what libraries print, there or on stderr, goes
/// nowhere: it is for neither the stream nor the user, who gets one line about a damaged log.
[[nodiscard]] int takeOverOutput();

}  // namespace hoctomap
