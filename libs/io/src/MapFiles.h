// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "hoctomap/io/Manifest.h"

namespace hoctomap {

/// @throws MapError if the directory is no map.
void requireMap(const std::filesystem::path& directory);

/// A manifest by its file's name.
/// @throws MapError if it is damaged, LimitError if it is too large, FileError if it cannot be read.
[[nodiscard]] Manifest readManifestFile(const std::filesystem::path& file);

/// The bytes of a file of the map, as the manifest vouches for them.
/// @param prefix whether the file may have more than belongs to the map.
/// @throws MapError if it is missing, or has another size or hash.
[[nodiscard]] std::string readChecked(const std::filesystem::path& directory, const FileRecord& record,
                                      bool prefix);

}  // namespace hoctomap
