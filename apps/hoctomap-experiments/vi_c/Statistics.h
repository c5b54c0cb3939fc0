// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace hoctomap {

struct MeanWithInterval {
  double mean = 0.0;
  double half_width = 0.0;  ///< of the 95 % confidence interval (Student's t); 0 for one value
};

/// @throws std::invalid_argument if empty
[[nodiscard]] MeanWithInterval meanOf(std::span<const double> values);

/// Spearman's rank correlation; ties have their mean rank. Nothing for fewer than three pairs, or if one side
/// is constant.
[[nodiscard]] std::optional<double> rankCorrelation(std::span<const double> a, std::span<const double> b);

}  // namespace hoctomap
