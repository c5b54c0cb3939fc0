// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>

#include "hoctomap/io/ScanStream.h"

namespace hoctomap {

/// Writes an observation-only gz rawlog of standard MRPT classes: true poses as CObservationRobotPose, depth
/// images as CObservation3DRangeScan (16-bit range image, with the picture as a JPEG), clouds as
/// CObservationPointCloud, object motions as CObservationRobotPose labelled `object_motion/<id>`. The same
/// messages give the same bytes.
///
/// The file is written under a temporary name beside its place and renamed by finish(); without finish()
/// nothing stays. Images stand in the log, or on request in files of the folder `LOG_Images` beside it
/// (pictures as PNG).
class LogWriter {
 public:
  /// `depth_unit_m`: metres a step of the range images; deeper than 65535 steps, and 0, is no return.
  /// @throws FileError if the temporary file cannot be made, ConfigError if the unit is not positive or the
  ///         folder for the images exists.
  LogWriter(const std::filesystem::path& log, double depth_unit_m, bool external_images = false);
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// Headers, warnings, skipped scans and ends are passed over.
  /// @throws FileError
  void write(const StreamMessage& message);

  /// Completes, syncs and renames. @throws FileError
  void finish();

 private:
  struct Output;
  struct Encoder;
  std::unique_ptr<Output> output_;
};

}  // namespace hoctomap
