// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "ManifestHead.h"
#include "NodeIndex.h"
#include "hoctomap/io/Manifest.h"

namespace hoctomap {

/// @throws MapError if the directory is no map.
void requireMap(const std::filesystem::path& directory);

/// Which kept state is the newest that has taken in no scan after `at_scan`; nothing if the map itself is it.
/// @param scans of the map itself
/// @throws MapError if there is none.
[[nodiscard]] std::optional<std::uint64_t> snapshotAt(const std::filesystem::path& directory,
                                                      std::uint64_t scans,
                                                      std::optional<std::uint64_t> at_scan);

/// The index that the head of a manifest names, if it is there, whole, and of these nodes. It is only quicker
/// than the manifest: without it everything can be read, too.
[[nodiscard]] std::optional<NodeIndex> readIndex(const std::filesystem::path& directory,
                                                 const ManifestHead& head);

/// A manifest by its file's name.
/// @throws MapError if it is damaged, LimitError if it is too large, FileError if it cannot be read.
[[nodiscard]] Manifest readManifestFile(const std::filesystem::path& file);

/// The bytes of a file of the map, as the manifest vouches for them.
/// @param prefix whether the file may have more than belongs to the map.
/// @throws MapError if it is missing, or has another size or hash.
[[nodiscard]] std::string readChecked(const std::filesystem::path& directory, const FileRecord& record,
                                      bool prefix);

}  // namespace hoctomap
