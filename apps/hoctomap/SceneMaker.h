// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "hoctomap/io/ChildProcess.h"

namespace hoctomap {

/// A `MapDirectory::SceneMaker` that has the helper write MRPT's scene of a map. Once.
class SceneMaker {
 public:
  /// Starts the helper, which loads its many libraries while the map is still being made.
  /// @throws FileError
  SceneMaker();
  /// @throws FileError
  void operator()(const std::filesystem::path& directory, const std::filesystem::path& file);

 private:
  ChildProcess helper_;
};

/// The same, without time to prepare.
void makeScene(const std::filesystem::path& directory, const std::filesystem::path& file);

}  // namespace hoctomap
