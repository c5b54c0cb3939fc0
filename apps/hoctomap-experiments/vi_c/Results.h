// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vi_c/Trial.h"

namespace hoctomap {

/// One line a view of a trial.
[[nodiscard]] std::string viewsCsv(const std::vector<Trial>& trials);
/// One line a step of the methods that choose.
[[nodiscard]] std::string stepsCsv(const std::vector<Trial>& trials);
/// One line a trial: how it ended, when coverage was reached, how well gains were foretold.
[[nodiscard]] std::string trialsCsv(const std::vector<Trial>& trials);
/// Tables for docs/reproduction.md, by scene and method; means with 95 % confidence intervals.
[[nodiscard]] std::string viCMarkdown(const std::vector<Trial>& trials);

/// Draws `coverage_views` and `coverage_travel` (mean coverage of each method, a panel a scene) as .png, and
/// leaves their gnuplot scripts beside them.
/// @throws FileError if gnuplot is not installed or fails
void drawViC(const std::vector<Trial>& trials, const std::filesystem::path& folder);

}  // namespace hoctomap
