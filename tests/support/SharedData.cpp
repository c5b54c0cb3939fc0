// SPDX-License-Identifier: BSD-3-Clause
#include "support/SharedData.h"

#include <cstdlib>

namespace hoctomap::test {

std::filesystem::path sourceDir() {
  return HOCTOMAP_SOURCE_DIR;
}

std::optional<std::filesystem::path> sharedData() {
  const char* set = std::getenv("HOCTOMAP_SHARED");
  const std::filesystem::path shared = set ? std::filesystem::path(set) : sourceDir() / ".." / "shared";
  const auto data = shared / "data";
  if (!std::filesystem::is_directory(data)) return std::nullopt;
  return data;
}

}  // namespace hoctomap::test
