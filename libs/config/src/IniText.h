// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hoctomap::ini {

/// Without blanks and tabs at both ends.
std::string_view trimmed(std::string_view text);

/// Without a comment: `;`, `#` or `//` at the beginning or after a blank.
std::string_view withoutComment(std::string_view line);

/// Bytes of a value in a message.
inline constexpr std::size_t longest_shown = 80;

/// Fit for a message of one line: control characters and broken UTF-8 as `\xNN`, cut after `longest` bytes.
std::string escaped(std::string_view text, std::size_t longest = std::string_view::npos);

/// `escaped` in double quotes, cut after `longest_shown` bytes.
std::string quoted(std::string_view text);

/// The shortest text that reads back as the same number.
std::string shortest(double value);

enum class Parsed { ok, not_a_number, not_finite };

/// The whole text as a number, whatever the locale; `value` only with `Parsed::ok`.
Parsed parseNumber(std::string_view text, double& value);
Parsed parseInteger(std::string_view text, std::int64_t& value);

/// The candidate with the smallest edit distance to `name`, case ignored, or "" if none is near.
std::string nearest(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace hoctomap::ini
