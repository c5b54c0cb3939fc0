// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace hoctomap {

/// Shortest text that reads back as the same number, whatever the locale.
[[nodiscard]] std::string shortestText(double value);

/// The same with a decimal point always: YAML 1.1 readers take `1e-05` for a text.
[[nodiscard]] std::string yamlNumber(double value);

/// A double-quoted YAML (and JSON) text; control characters escaped.
[[nodiscard]] std::string yamlText(std::string_view text);

/// The number the whole text stands for; nothing if it is none or not finite.
[[nodiscard]] std::optional<double> parseNumber(std::string_view text);
[[nodiscard]] std::optional<std::uint64_t> parseCount(std::string_view text);

/// `value` with at least `digits` digits, filled up with zeros.
[[nodiscard]] std::string padded(std::uint64_t value, std::size_t digits);

}  // namespace hoctomap
