// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace hoctomap {

/// Runs gnuplot on a script, which stays beside the picture that it draws.
/// @throws FileError if gnuplot is not installed or fails
void drawPlot(const std::filesystem::path& script);

}  // namespace hoctomap
