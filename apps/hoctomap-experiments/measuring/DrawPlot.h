// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace hoctomap {

/// Draws a picture with gnuplot, and leaves the script beside it (extension .gnuplot).
/// @param script  without an output of its own
/// @throws FileError if gnuplot is not installed or fails
void drawPlot(const std::filesystem::path& picture, const std::string& script);

}  // namespace hoctomap
