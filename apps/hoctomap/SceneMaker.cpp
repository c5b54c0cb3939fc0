// SPDX-License-Identifier: BSD-3-Clause
#include "SceneMaker.h"

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/ChildProcess.h"

namespace hoctomap {

void makeScene(const std::filesystem::path& directory, const std::filesystem::path& file) {
  if (runHelper({"scene", directory.string(), file.string()}) != 0) {
    throw FileError(file.string() + ": the scene could not be written");
  }
}

}  // namespace hoctomap
