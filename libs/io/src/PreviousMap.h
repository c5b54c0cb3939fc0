// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "Disk.h"
#include "hoctomap/io/Manifest.h"

namespace hoctomap {

// Overwriting without a moment in which there is no whole map: a new map has files of the same names as the
// old one. So the old map is first given other names under `previous/` (hard links) and a manifest that says
// so; then its old names are free. The new map's manifest ends it.

/// Gives every file of the map a name under `previous/`, and commits a manifest with these names.
void setAside(const Disk& disk, const std::filesystem::path& directory, const Manifest& manifest);

/// The same with `events.csv` alone, for a commit that takes rows back which the map has.
/// @returns the manifest of the map, as it is on disk now.
[[nodiscard]] Manifest setEventsAside(const Disk& disk, const std::filesystem::path& directory,
                                      Manifest manifest);

/// The opposite of both, for a map that is to be continued after all. Does nothing if no file is set aside.
/// @returns the manifest with the usual names.
[[nodiscard]] Manifest bringBack(const Disk& disk, const std::filesystem::path& directory, Manifest manifest);

/// Removes what is ours under `previous/`, except files that `manifest` names.
void removePrevious(const Disk& disk, const std::filesystem::path& directory, const Manifest& manifest);

}  // namespace hoctomap
