// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include "hoctomap/io/LogReadOptions.h"
#include "hoctomap/io/ScanStream.h"
#include "hoctomap/mrpt_io/ReadProgress.h"

namespace hoctomap {

/// Streams the 3D scans of logs with their poses, in two passes: the first reads all logs once and keeps only
/// poses and counts, so that damage, missing poses and empty selections show before anything is mapped; the
/// second sends scan by scan. One object of a log is in memory at a time.
class LogReader {
 public:
  /// Takes each message with the position of the object it stems from.
  using Sink = std::function<void(const StreamMessage&, const StreamPosition&)>;

  /// First pass. `progress` is kept up to date and must outlive the reader.
  /// @throws InputError (log, poses), LimitError, ConfigError.
  LogReader(LogReadOptions options, ReadProgress& progress);
  ~LogReader();

  /// Second pass: warnings, the header, then scans, skipped scans, motions, warnings, and the end.
  /// @throws InputError if a log changed since the first pass or names files outside of its folder; what
  /// `sink`
  ///         throws.
  void stream(const Sink& sink);

  [[nodiscard]] const StreamHeader& header() const;

 private:
  struct Passes;
  std::unique_ptr<Passes> passes_;
};

}  // namespace hoctomap
