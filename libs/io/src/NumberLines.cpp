// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/NumberLines.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"

namespace hoctomap {

namespace {
constexpr std::size_t kMaxLineBytes = 4096;
}

std::ifstream openText(const std::filesystem::path& file, const std::string& what) {
  const std::string name = escapedText(file.string());
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw InputError(name + ": no such " + what);
  if (!std::filesystem::is_regular_file(file, error)) throw InputError(name + ": not a regular file");
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(name + ": cannot open the " + what);
  return in;
}

void forEachLine(std::istream& in, const std::string& name,
                 const std::function<void(std::string_view, std::size_t)>& take) {
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    if (line.starts_with('#') || line.starts_with('%')) continue;
    try {
      if (line.size() > kMaxLineBytes) throw InputError("the line is too long");
      if (!wordsOf(line).empty()) take(line, number);
    } catch (const InputError& what) {
      throw InputError(name + ":" + std::to_string(number) + ": " + what.what());
    }
  }
  if (in.bad()) throw InputError(name + ": cannot be read");
}

std::vector<std::string_view> wordsOf(std::string_view line) {
  constexpr std::string_view kSpace = " \t\r";
  std::vector<std::string_view> words;
  for (auto at = line.find_first_not_of(kSpace); at != std::string_view::npos;) {
    const auto end = std::min(line.find_first_of(kSpace, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kSpace, end);
  }
  return words;
}

double numberFrom(std::string_view word) {
  if (word.find(',') != std::string_view::npos)
    throw InputError("'" + escapedText(word, 60) +
                     "': numbers have a decimal point and stand between spaces, without commas");
  std::string_view digits = word;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size())
    throw InputError("'" + escapedText(word, 60) + "' is not a number");
  if (!std::isfinite(value)) throw InputError("'" + escapedText(word, 60) + "' is not finite");
  return value;
}

std::vector<double> numbersFrom(std::string_view line) {
  std::vector<double> numbers;
  for (const std::string_view word : wordsOf(line)) numbers.push_back(numberFrom(word));
  return numbers;
}

}  // namespace hoctomap
