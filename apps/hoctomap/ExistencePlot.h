// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "NodeLife.h"

namespace hoctomap {

/// The gnuplot script of a node's existence over the scans, and of the beams that it comes from; data
/// included. `last_scan`: the last one of the map.
[[nodiscard]] std::string existencePlotScript(const NodeLife& life, std::uint64_t last_scan);

/// Draws it as SVG. gnuplot (Debian's gnuplot-nox) is $HOCTOMAP_GNUPLOT if set, else found on the PATH.
/// @throws FileError if gnuplot is missing or fails, or the file cannot be written.
void drawExistence(const NodeLife& life, std::uint64_t last_scan, const std::filesystem::path& file);

}  // namespace hoctomap
