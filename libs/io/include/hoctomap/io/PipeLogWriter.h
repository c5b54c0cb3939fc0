// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "hoctomap/io/ChildProcess.h"
#include "hoctomap/io/ScanStream.h"

namespace hoctomap {

/// Writes a rawlog through `hoctomap-mrpt write-log`. The log appears under its name only when finish()
/// returns; destroying the writer before that leaves nothing behind.
///
/// A scan is written with its sensor pose relative to the last TruthPose of the same stamp, which stands
/// before it; without one, with its pose in the world.
class PipeLogWriter {
 public:
  /// `depth_unit_m`: metres per step of the 16-bit range images; depths beyond 65535 steps are no return.
  /// `external_images`: as files in `LOG_Images` beside the log.
  /// @throws FileError if the helper cannot be started.
  explicit PipeLogWriter(const std::filesystem::path& log, double depth_unit_m = 0.001,
                         bool external_images = false);

  /// DepthScan, CloudScan, TruthPose and ObjectMotion.
  /// @throws FileError or what else the helper reports.
  void write(const StreamMessage& message);

  /// Completes the log: written, synced, renamed.
  /// @throws FileError if that fails.
  void finish();

 private:
  [[noreturn]] void throwFailure();

  ChildProcess child_;
  ScanStreamWriter writer_;
  std::uint64_t scans_ = 0;
};

}  // namespace hoctomap
