// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>

#include "hoctomap/io/ChildProcess.h"
#include "hoctomap/io/ScanStream.h"

namespace hoctomap {

/// Clouds of files, read by the helper `hoctomap-cloud`: a foreign file may crash the library that reads it.
class CloudReader {
 public:
  /// The points of a `.pcd`, `.ply` or `.bin` file in its own frame, without those that are not finite.
  /// @throws InputError naming the file if it is no whole cloud; LimitError; FileError if the helper is
  /// missing
  [[nodiscard]] CloudScan read(const std::filesystem::path& file);

 private:
  std::unique_ptr<ChildProcess> child_;
  std::unique_ptr<ScanStreamWriter> requests_;  ///< a StreamWarning with the name of a file each
  std::unique_ptr<ScanStreamReader> answers_;
};

}  // namespace hoctomap
