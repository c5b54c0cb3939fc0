// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace hoctomap {

/// One row of the table: something that must be shown.
struct TableRow {
  std::string what;
  std::string ours;   ///< our figures, with units
  std::string stock;  ///< those of stock OctoMap, or of what else is compared with
  double value = 0.0;
  std::string unit;  ///< of the value: `x` for ratios
  double goal = 0.0;
  bool at_least = true;  ///< whether the goal is a lower bound
  std::string equal;     ///< whether the `.ot` bytes are equal: yes, NO, or empty
  [[nodiscard]] bool met() const { return at_least ? value >= goal : value <= goal; }
};

[[nodiscard]] std::string tableMarkdown(const std::vector<TableRow>& rows);
/// `what,ours,stock,value,unit,goal,met,equal`
[[nodiscard]] std::string tableCsv(const std::vector<TableRow>& rows);

}  // namespace hoctomap
