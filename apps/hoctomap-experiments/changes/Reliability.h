// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>

#include "changes/ChangeRun.h"

namespace hoctomap {

/// How probabilities of existence fit what is true.
struct Reliability {
  struct Bin {
    std::size_t count = 0;
    double mean_probability = 0.0;
    double share_existing = 0.0;
  };
  std::array<Bin, 10> bins;     ///< by probability, of equal width
  double brier = 0.0;           ///< mean of (p - truth)^2 (Brier 1950)
  double brier_constant = 0.0;  ///< of one who always says the share that exists
};

[[nodiscard]] Reliability reliabilityOf(std::span<const ExistenceCheck> checks);

/// Markdown table of the bins.
[[nodiscard]] std::string reliabilityMarkdown(const Reliability& reliability);

/// Draws `reliability.png`: the share that exists over the mean probability of each bin, beside the number of
/// entries.
/// @throws FileError if gnuplot is not installed or fails
void drawReliability(const Reliability& reliability, const std::filesystem::path& folder);

}  // namespace hoctomap
