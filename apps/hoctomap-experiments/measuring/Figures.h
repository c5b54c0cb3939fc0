// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "measuring/Stopwatch.h"

namespace hoctomap {

/// What one measurement found: named figures, in order. As text, one `name value` a line.
class Figures {
 public:
  void add(const std::string& name, double value);
  void add(const std::string& name, std::uint64_t value);
  void add(const std::string& name, const std::string& value);
  /// `user_s`, `cpu_s`, `wall_s`
  void add(const Elapsed& elapsed);

  [[nodiscard]] bool contains(std::string_view name) const;
  /// @throws std::out_of_range if there is no such figure
  [[nodiscard]] const std::string& text(std::string_view name) const;
  [[nodiscard]] double number(std::string_view name) const;
  [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& all() const { return all_; }

  [[nodiscard]] std::string lines() const;
  [[nodiscard]] static Figures parse(std::string_view lines);

 private:
  std::vector<std::pair<std::string, std::string>> all_;
};

/// The number with `digits` significant digits, without an exponent between 1e-4 and 1e6; the same in any
/// locale.
[[nodiscard]] std::string numberText(double value, int digits = 9);

/// The middle value; of an even number, the mean of the two. @throws std::invalid_argument if empty
[[nodiscard]] double median(std::vector<double> values);

}  // namespace hoctomap
