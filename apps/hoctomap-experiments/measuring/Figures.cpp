// SPDX-License-Identifier: BSD-3-Clause
#include "measuring/Figures.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>

namespace hoctomap {

std::string numberText(double value, int digits) {
  std::array<char, 64> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits);
  return {text.data(), end.ptr};
}

double median(std::vector<double> values) {
  if (values.empty()) throw std::invalid_argument("the median of nothing");
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

void Figures::add(const std::string& name, double value) {
  all_.emplace_back(name, numberText(value));
}

void Figures::add(const std::string& name, std::uint64_t value) {
  all_.emplace_back(name, std::to_string(value));
}

void Figures::add(const std::string& name, const std::string& value) {
  all_.emplace_back(name, value);
}

void Figures::add(const Elapsed& elapsed) {
  add("user_s", elapsed.user_s);
  add("cpu_s", elapsed.cpu_s);
  add("wall_s", elapsed.wall_s);
}

bool Figures::contains(std::string_view name) const {
  return std::any_of(all_.begin(), all_.end(), [&](const auto& figure) { return figure.first == name; });
}

const std::string& Figures::text(std::string_view name) const {
  for (const auto& [key, value] : all_) {
    if (key == name) return value;
  }
  throw std::out_of_range("no figure " + std::string(name));
}

double Figures::number(std::string_view name) const {
  const std::string& value = text(name);
  double number = 0.0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (error != std::errc() || end != value.data() + value.size()) {
    throw std::invalid_argument(std::string(name) + " is no number: " + value);
  }
  return number;
}

std::string Figures::lines() const {
  std::string text;
  for (const auto& [name, value] : all_) text.append(name).append(" ").append(value).append("\n");
  return text;
}

Figures Figures::parse(std::string_view lines) {
  Figures figures;
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    const std::string_view line = lines.substr(0, end);
    const std::size_t space = line.find(' ');
    if (space != std::string_view::npos) {
      figures.all_.emplace_back(line.substr(0, space), line.substr(space + 1));
    }
    lines.remove_prefix(std::min(end + 1, lines.size()));
  }
  return figures;
}

}  // namespace hoctomap
