// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>

#include <filesystem>
#include <string>

#include "hoctomap/io/ChildProcess.h"

namespace hoctomap {

/// The folder of a log's external files by MRPT's habit: `NAME_Images` beside `NAME.rawlog`, else `Images`.
[[nodiscard]] std::filesystem::path imagesFolder(const std::filesystem::path& log);

/// A file that a log names. Only names that stay below the folder are allowed: a log from elsewhere must not
/// make the program read other files.
class ExternalFile {
 public:
  /// @throws InputError for an absolute name, one with `..`, and one that leads through a symbolic link.
  ExternalFile(const std::filesystem::path& folder, const std::string& name);
  [[nodiscard]] bool exists() const { return file_.get() >= 0; }
  /// Open for reading, at the begin; to be asked only if it exists.
  [[nodiscard]] int descriptor() const { return file_.get(); }
  /// Of its bytes, in hex.
  /// @throws InputError if it cannot be read.
  [[nodiscard]] std::string sha256() const;

 private:
  std::string name_;
  UniqueFd file_;  ///< none if there is no such regular file
};

/// Loads what a depth camera's scan stores outside as text by MRPT's loader, after its names were checked.
/// @return false if that fails
[[nodiscard]] bool loadExternals(const mrpt::obs::CObservation& observation,
                                 const std::filesystem::path& folder);

}  // namespace hoctomap
