// SPDX-License-Identifier: BSD-3-Clause
// What can be done with one row of the table of keys.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "IniText.h"
#include "SettingsKeys.h"

namespace hoctomap::keys {

inline constexpr const char* none = "none";

/// The words of a choice, in the order of the enumerators; empty for numbers.
template <class T>
[[nodiscard]] std::vector<std::string> words() {
  if constexpr (std::is_same_v<T, bool>) return {"false", "true"};
  if constexpr (std::is_same_v<T, SegmentationMethod>) return {"euclidean", "convex_patches"};
  if constexpr (std::is_same_v<T, FrameChoice>) return {"world", "pca"};
  if constexpr (std::is_same_v<T, Carve>) return {"own", "scan"};
  if constexpr (std::is_same_v<T, RuleKind>) return {"none", "object", "table"};
  if constexpr (std::is_same_v<T, RuleShape>) return {"any", "flat", "compact", "tall"};
  if constexpr (std::is_same_v<T, Grazing>) return {"clear", "spare"};
  if constexpr (std::is_same_v<T, GainMeasure>) return {"entropy", "swept_cells"};
  if constexpr (std::is_same_v<T, UnknownSpace>) return {"transparent", "occluding"};
  if constexpr (std::is_same_v<T, UtilityForm>) return {"ratio", "additive"};
  return {};
}

template <class T>
inline constexpr bool is_choice = std::is_enum_v<T> || std::is_same_v<T, bool>;

/// A value as INI text; numbers as the shortest text that reads back the same.
template <class Owner>
[[nodiscard]] std::string valueText(const Key<Owner>& key, Owner& owner) {
  const auto text = [&](auto member) -> std::string {
    const auto& value = member(owner);
    using T = std::remove_cvref_t<decltype(value)>;
    if constexpr (is_choice<T>) return words<T>().at(static_cast<std::size_t>(value));
    if constexpr (std::is_integral_v<T>) return std::to_string(value);
    if constexpr (std::is_floating_point_v<T>) {
      return key.may_be_none && value < 0.0 ? none : ini::shortest(value);
    }
  };
  return std::visit(text, key.access);
}

/// The values that a key takes, for people.
template <class Owner>
[[nodiscard]] std::string rangeText(const Key<Owner>& key) {
  const auto text = [&]<class T>(T& (*)(Owner&)) -> std::string {
    std::string result = key.may_be_none ? std::string(none) + ", or " : "";
    if (!is_choice<T>) return result + key.range.text();
    for (const std::string& word : words<T>()) result += (result.empty() ? "" : ", ") + word;
    return result;
  };
  return std::visit(text, key.access);
}

/// Reads `key` of `section` into `owner`, which holds the default.
template <class Owner>
void read(IniDocument& document, const std::string& section, const Key<Owner>& key, Owner& owner) {
  const auto readInto = [&](auto member) {
    auto& value = member(owner);
    using T = std::remove_cvref_t<decltype(value)>;
    if constexpr (is_choice<T>) {
      const std::vector<std::string> all = words<T>();
      const std::string word = document.choice(section, key.name, valueText(key, owner), all);
      value = static_cast<T>(std::find(all.begin(), all.end(), word) - all.begin());
    } else if constexpr (std::is_integral_v<T>) {
      const auto fallback = static_cast<std::int64_t>(value);
      value = static_cast<T>(document.integer(section, key.name, fallback, key.range));
    } else if (key.may_be_none) {
      const auto fallback = value < 0.0 ? std::nullopt : std::optional(value);
      value = document.numberOrNone(section, key.name, fallback, key.range).value_or(-1.0);
    } else {
      value = document.number(section, key.name, value, key.range);
    }
  };
  std::visit(readInto, key.access);
}

/// The value of a number.
template <class Owner>
[[nodiscard]] double numberOf(const Key<Owner>& key, Owner& owner) {
  const double value =
      std::visit([&](auto member) { return static_cast<double>(member(owner)); }, key.access);
  return key.may_be_none && value < 0.0 ? std::numeric_limits<double>::infinity() : value;
}

/// Notes the pairs of numbers of `section` that are out of order, at the one that was given later. Keys know
/// their section if `section` is empty.
template <class Owner>
void checkOrders(IniDocument& document, const std::string& section, std::span<const Order<Owner>> orders,
                 std::span<const Key<Owner>> all, Owner& owner) {
  const auto keyOf = [&](const Access<Owner>& access) -> const Key<Owner>& {
    return *std::find_if(all.begin(), all.end(), [&](const auto& key) { return key.access == access; });
  };
  for (const Order<Owner>& order : orders) {
    const Key<Owner>& low = keyOf(order.low);
    const Key<Owner>& high = keyOf(order.high);
    const double a = numberOf(low, owner);
    const double b = numberOf(high, owner);
    if (order.strict ? a < b : a <= b) continue;
    const std::string where = section.empty() ? low.section : section;
    const bool high_is_wrong = document.position(where, high.name) > document.position(where, low.name);
    const Key<Owner>& wrong = high_is_wrong ? high : low;
    const Key<Owner>& other = high_is_wrong ? low : high;
    const std::string relation =
        high_is_wrong ? (order.strict ? "above " : "at least ") : (order.strict ? "below " : "at most ");
    document.problem(where, wrong.name,
                     valueText(wrong, owner) + " must be " + relation + other.name + ", which is " +
                         valueText(other, owner));
  }
}

}  // namespace hoctomap::keys
