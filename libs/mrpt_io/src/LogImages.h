// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <filesystem>

namespace hoctomap {

/// The images of a log that stand beside it, in `LOG_Images`, where MRPT's programs look for them. Until
/// commit() they lie in a hidden folder; without it nothing stays.
class LogImages {
 public:
  /// @throws ConfigError if there is such a folder already, FileError if none can be made.
  explicit LogImages(const std::filesystem::path& log);
  ~LogImages();
  LogImages(const LogImages&) = delete;
  LogImages& operator=(const LogImages&) = delete;

  /// Moves the range image and the picture of a scan to files of their own. @throws FileError
  void moveOut(mrpt::obs::CObservation3DRangeScan& scan);

  /// Gives the folder its name. @throws FileError
  void commit();
  /// Takes the name back: the log could not be completed.
  void withdraw();

 private:
  std::filesystem::path folder_;
  std::filesystem::path temporary_;
  std::uint64_t scans_ = 0;
};

}  // namespace hoctomap
