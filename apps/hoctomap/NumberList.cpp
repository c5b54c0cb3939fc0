// SPDX-License-Identifier: BSD-3-Clause
#include "NumberList.h"

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>

#include "hoctomap/io/EscapedText.h"

namespace hoctomap {

namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

double number(std::string_view field) {
  std::string_view digits = trimmed(field);
  const bool plus = digits.size() > 1 && digits[0] == '+' && digits[1] != '-';
  if (plus) digits.remove_prefix(1);  // std::from_chars knows none
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value)) {
    throw std::invalid_argument("\"" + escapedText(trimmed(field), 60) + "\" is no finite number");
  }
  return value;
}

}  // namespace

void readNumbers(std::string_view text, std::vector<double>& numbers) {
  numbers.clear();
  for (auto comma = text.find(','); comma != std::string_view::npos; comma = text.find(',')) {
    numbers.push_back(number(text.substr(0, comma)));
    text.remove_prefix(comma + 1);
  }
  numbers.push_back(number(text));
}

std::vector<double> numberList(std::string_view text) {
  std::vector<double> numbers;
  readNumbers(text, numbers);
  return numbers;
}

}  // namespace hoctomap
