// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/CsvText.h"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>

#include "hoctomap/geometry/Errors.h"

namespace hoctomap {

void appendNumber(std::string& line, double value) {
  if (std::abs(value) < 0.5e-6) value = 0.0;
  std::array<char, 400> digits;  // the largest double has 309 digits before the point
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed, 6);
  line += ',';
  line.append(digits.data(), end.ptr);
}

void appendVector(std::string& line, const Eigen::Vector3d& value) {
  for (const double v : value) appendNumber(line, v);
}

std::string csvField(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

void writeTextFile(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (!file) throw FileError(path.string() + ": cannot write");
}

}  // namespace hoctomap
