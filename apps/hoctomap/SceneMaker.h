// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace hoctomap {

/// `MapDirectory::SceneMaker` that has the helper write MRPT's scene of the map in `directory`.
/// @throws FileError
void makeScene(const std::filesystem::path& directory, const std::filesystem::path& file);

}  // namespace hoctomap
