// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace hoctomap {

/// `value` with a fixed number of digits after the point; zero has no sign.
[[nodiscard]] std::string fixedText(double value, int digits);

/// Columns as wide as their longest text. Columns of numbers are aligned to the right.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> titles);
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  [[nodiscard]] std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace hoctomap
