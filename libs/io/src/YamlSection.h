// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <yaml-cpp/yaml.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "NumberText.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"

namespace hoctomap {

/// A part of a YAML document that knows where it stands, so that every refusal names file, line and key.
class YamlSection {
 public:
  YamlSection(YAML::Node node, std::string place) : node_(std::move(node)), place_(std::move(place)) {}

  [[noreturn]] void refuse(const std::string& what) const {
    const auto line = node_.Mark().line;
    throw MapError(place_ + (line >= 0 ? " (line " + std::to_string(line + 1) + ")" : "") + ": " + what);
  }

  [[nodiscard]] bool has(const std::string& key) const { return node_.IsMap() && node_[key].IsDefined(); }
  [[nodiscard]] YamlSection operator[](const std::string& key) const {
    if (!node_.IsMap()) refuse("is no mapping of keys to values");
    const YAML::Node child = node_[key];
    if (!child.IsDefined()) refuse("has no key `" + key + "`");
    return {child, place_ + ": " + key};
  }
  [[nodiscard]] std::vector<YamlSection> items() const {
    if (!node_.IsSequence()) refuse("is no list");
    std::vector<YamlSection> all;
    all.reserve(node_.size());
    for (const auto& item : node_) all.emplace_back(item, place_ + "[" + std::to_string(all.size()) + "]");
    return all;
  }

  [[nodiscard]] bool isNull() const { return node_.IsNull(); }
  [[nodiscard]] std::string text() const {
    if (!node_.IsScalar()) refuse("is no text");
    return node_.Scalar();
  }
  [[nodiscard]] double number() const {
    const auto value = parseNumber(text());
    if (!value) refuse("\"" + escapedText(text(), 60) + "\" is no finite number");
    return *value;
  }
  [[nodiscard]] bool flag() const {
    const std::string word = text();
    if (word != "true" && word != "false") refuse("is neither true nor false");
    return word == "true";
  }
  [[nodiscard]] std::uint64_t count() const {
    const auto value = parseCount(text());
    if (!value) refuse("\"" + escapedText(text(), 60) + "\" is no whole number from 0");
    return *value;
  }
  template <std::size_t N>
  [[nodiscard]] std::array<double, N> numbers() const {
    const auto all = items();
    if (all.size() != N) refuse("needs " + std::to_string(N) + " numbers, has " + std::to_string(all.size()));
    std::array<double, N> values{};
    for (std::size_t i = 0; i < N; ++i) values.at(i) = all[i].number();
    return values;
  }

 private:
  YAML::Node node_;
  std::string place_;
};

}  // namespace hoctomap
