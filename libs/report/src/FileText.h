// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "hoctomap/geometry/Errors.h"

namespace hoctomap {

/// All bytes of a file. @throws FileError
[[nodiscard]] inline std::string fileText(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (in.peek() != std::ifstream::traits_type::eof()) text << in.rdbuf();
  if (!in.is_open() || in.bad()) throw FileError(file.string() + ": cannot be read");
  return std::move(text).str();
}

}  // namespace hoctomap
