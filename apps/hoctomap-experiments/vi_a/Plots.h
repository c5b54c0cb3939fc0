// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "vi_a/Results.h"

namespace hoctomap {

/// Draws `fig4_memory` and `fig5_runtime` as .svg and .png, and leaves the gnuplot scripts they were made
/// with beside them (data included). Axes are logarithmic; predicted points have open symbols.
/// @throws FileError if gnuplot is not installed or fails
void drawPlots(const ViAResults& results, const std::filesystem::path& folder);

/// The gnuplot commands of one figure, without terminal and output.
enum class Quantity { memory, runtime };
[[nodiscard]] std::string plotCommands(const ViAResults& results, Quantity quantity);

}  // namespace hoctomap
