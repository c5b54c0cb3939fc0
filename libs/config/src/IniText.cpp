// SPDX-License-Identifier: BSD-3-Clause
#include "IniText.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <system_error>

namespace hoctomap::ini {
namespace {

bool isBlank(char c) {
  return c == ' ' || c == '\t';
}

bool isContinuation(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

// Bytes of the printable character that `text` begins with; 0 if it is to be escaped: a control character
// (C0, DEL, C1) or broken UTF-8.
std::size_t printableLength(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  if (lead < 0x80) return lead >= 0x20 && lead != 0x7F ? 1 : 0;
  const std::size_t length = lead >= 0xF5 ? 0 : lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : lead >= 0xC2 ? 2 : 0;
  if (length == 0 || text.size() < length) return 0;
  if (!std::all_of(text.begin() + 1, text.begin() + static_cast<std::ptrdiff_t>(length), isContinuation)) {
    return 0;
  }
  const bool c1 = lead == 0xC2 && static_cast<unsigned char>(text[1]) < 0xA0;
  return c1 ? 0 : length;
}

std::string hexEscape(char c) {
  constexpr std::string_view digits = "0123456789abcdef";
  const auto byte = static_cast<unsigned char>(c);
  return {'\\', 'x', digits[byte >> 4U], digits[byte & 15U]};
}

// One leading plus sign is allowed, as in "+0.5", but std::from_chars knows none.
std::string_view withoutPlus(std::string_view text) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  return plus ? text.substr(1) : text;
}

template <typename Number>
Parsed parseWhole(std::string_view text, Number& value) {
  text = withoutPlus(text);
  const char* end = text.data() + text.size();
  Number result{};
  const auto [rest, error] = std::from_chars(text.data(), end, result);
  if (rest != end || error == std::errc::invalid_argument) return Parsed::not_a_number;
  if (error == std::errc::result_out_of_range) return Parsed::not_finite;
  value = result;
  return Parsed::ok;
}

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

// Levenshtein's, row by row. `row[j]`: distance of the letters of `a` so far to the first j + 1 of `b`.
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size());
  std::iota(row.begin(), row.end(), std::size_t{1});
  std::size_t distance = b.size();
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = i;
    distance = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (lower(a[i]) == lower(b[j]) ? 0 : 1);
      diagonal = row[j];
      distance = std::min({replaced, diagonal + 1, distance + 1});
      row[j] = distance;
    }
  }
  return distance;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view withoutComment(std::string_view line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (i > 0 && !isBlank(line[i - 1])) continue;
    if (line[i] == ';' || line[i] == '#' || line.substr(i, 2) == "//") return line.substr(0, i);
  }
  return line;
}

std::string escaped(std::string_view text, std::size_t longest) {
  std::string result;
  while (!text.empty()) {
    if (result.size() >= longest) return result + "...";
    const std::size_t length = printableLength(text);
    result += length > 0 ? std::string(text.substr(0, length)) : hexEscape(text.front());
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

std::string quoted(std::string_view text) {
  return '"' + escaped(text, longest_shown) + '"';
}

std::string shortest(double value) {
  // Plain digits where people would write them so: 0.0001, not 1e-04.
  const double size = std::abs(value);
  const bool plain = value == 0.0 || (size >= 1e-6 && size < 1e9);
  std::array<char, 64> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                    plain ? std::chars_format::fixed : std::chars_format::scientific);
  return {buffer.data(), result.ptr};
}

Parsed parseNumber(std::string_view text, double& value) {
  double result = 0.0;
  const Parsed parsed = parseWhole(text, result);
  if (parsed != Parsed::ok) return parsed;
  if (!std::isfinite(result)) return Parsed::not_finite;
  value = result;
  return Parsed::ok;
}

Parsed parseInteger(std::string_view text, std::int64_t& value) {
  return parseWhole(text, value);
}

std::string nearest(std::string_view name, const std::vector<std::string>& candidates) {
  // A third of the letters wrong is still a typing error, more is another word.
  std::size_t best = std::max<std::size_t>(name.size() / 3, 1) + 1;
  std::string result;
  for (const std::string& candidate : candidates) {
    const std::size_t longer = std::max(candidate.size(), name.size());
    if (longer - std::min(candidate.size(), name.size()) >= best) continue;
    const std::size_t distance = editDistance(name, candidate);
    if (distance < best && distance < longer) {
      best = distance;
      result = candidate;
    }
  }
  return result;
}

}  // namespace hoctomap::ini
