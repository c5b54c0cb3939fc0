// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/config/IniDocument.h"

#include <algorithm>
#include <cmath>

#include "IniText.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {
namespace {

constexpr std::size_t max_problems = 100;  // more are counted only: the file is something else

std::string didYouMean(const std::string& suggestion) {
  return suggestion.empty() ? "" : "; did you mean " + ini::escaped(suggestion, ini::longest_shown) + "?";
}

std::string notANumber(std::string_view text, const std::string& kind) {
  if (text.empty()) return "has no value";
  const bool comma = text.find(',') != std::string_view::npos;
  return ini::quoted(text) + " is not a " + kind + (comma ? " (the decimal sign is a point)" : "");
}

std::string outOfRange(std::string_view text, const Range& range) {
  const std::string bounds = range.text();
  return ini::quoted(text) + " is out of range" + (bounds == "any" ? "" : ": must be " + bounds);
}

std::vector<std::string_view> splitNumbers(std::string_view text) {
  std::vector<std::string_view> parts;
  while (!text.empty()) {
    const std::string_view part = text.substr(0, text.find_first_of(" \t,"));
    parts.push_back(part);
    text = ini::trimmed(text.substr(part.size()));
    if (!text.starts_with(',')) continue;
    text = ini::trimmed(text.substr(1));
    if (text.empty()) parts.push_back(text);  // a comma at the end: an empty number, which is refused
  }
  return parts;
}

}  // namespace

bool Range::contains(double value) const {
  return (open_min ? value > min : value >= min) && (open_max ? value < max : value <= max);
}

std::string Range::text() const {
  const std::string low = std::isinf(min) ? "" : (open_min ? "> " : ">= ") + ini::shortest(min);
  const std::string high = std::isinf(max) ? "" : (open_max ? "< " : "<= ") + ini::shortest(max);
  if (low.empty() && high.empty()) return "any";
  return low + (low.empty() || high.empty() ? "" : " and ") + high;
}

bool IniDocument::hasSection(const std::string& section) const {
  return section_lines_.contains(section);
}

bool IniDocument::has(const std::string& section, const std::string& key) const {
  return entries_.contains({section, key});
}

int IniDocument::position(const std::string& section, const std::string& key) const {
  const auto entry = entries_.find({section, key});
  return entry == entries_.end() ? 0 : entry->second.line;
}

IniDocument::Entry* IniDocument::ask(const std::string& section, const std::string& key) {
  known_.insert({section, key});
  const auto found = entries_.find({section, key});
  if (found == entries_.end()) return nullptr;
  found->second.used = true;
  return &found->second;
}

std::optional<double> IniDocument::checkedNumber(std::string_view text, Range range,
                                                 const std::string& section, const std::string& key) {
  double value = 0.0;
  switch (ini::parseNumber(text, value)) {
    case ini::Parsed::not_a_number:
      problem(section, key, notANumber(text, "number"));
      return std::nullopt;
    case ini::Parsed::not_finite:
      problem(section, key, ini::quoted(text) + " is not a finite number");
      return std::nullopt;
    case ini::Parsed::ok:
      break;
  }
  if (range.contains(value)) return value;
  problem(section, key, outOfRange(text, range));
  return std::nullopt;
}

double IniDocument::number(const std::string& section, const std::string& key, double fallback, Range range) {
  const Entry* entry = ask(section, key);
  return entry == nullptr ? fallback : checkedNumber(entry->value, range, section, key).value_or(fallback);
}

std::optional<double> IniDocument::numberOrNone(const std::string& section, const std::string& key,
                                                std::optional<double> fallback, Range range) {
  const Entry* entry = ask(section, key);
  if (entry == nullptr) return fallback;
  if (entry->value == "none") return std::nullopt;
  const std::optional<double> value = checkedNumber(entry->value, range, section, key);
  return value ? value : fallback;
}

std::int64_t IniDocument::integer(const std::string& section, const std::string& key, std::int64_t fallback,
                                  Range range) {
  const Entry* entry = ask(section, key);
  if (entry == nullptr) return fallback;
  std::int64_t value = 0;
  const ini::Parsed parsed = ini::parseInteger(entry->value, value);
  if (parsed == ini::Parsed::ok && range.contains(static_cast<double>(value))) return value;
  problem(section, key,
          parsed == ini::Parsed::not_a_number ? notANumber(entry->value, "whole number")
                                              : outOfRange(entry->value, range));
  return fallback;
}

bool IniDocument::boolean(const std::string& section, const std::string& key, bool fallback) {
  return choice(section, key, fallback ? "true" : "false", {"true", "false"}) == "true";
}

std::string IniDocument::text(const std::string& section, const std::string& key,
                              const std::string& fallback) {
  const Entry* entry = ask(section, key);
  return entry == nullptr ? fallback : entry->value;
}

std::string IniDocument::choice(const std::string& section, const std::string& key,
                                const std::string& fallback, const std::vector<std::string>& choices) {
  const Entry* entry = ask(section, key);
  if (entry == nullptr) return fallback;
  if (std::find(choices.begin(), choices.end(), entry->value) != choices.end()) return entry->value;
  std::string what = entry->value.empty() ? "has no value" : ini::quoted(entry->value) + " is none";
  what += entry->value.empty() ? ": must be one of " : " of ";
  for (const std::string& one : choices) what += (&one == &choices.front() ? "" : ", ") + one;
  problem(section, key, what);
  return fallback;
}

std::vector<double> IniDocument::numbers(const std::string& section, const std::string& key,
                                         const std::vector<double>& fallback,
                                         std::optional<std::size_t> count, Range range) {
  const Entry* entry = ask(section, key);
  if (entry == nullptr) return fallback;
  const std::vector<std::string_view> parts = splitNumbers(entry->value);
  if (parts.empty() || (count && parts.size() != *count)) {
    problem(section, key,
            "needs " + (count ? std::to_string(*count) : std::string("one or more")) + " numbers, has " +
                std::to_string(parts.size()));
    return fallback;
  }
  std::vector<double> values;
  for (const std::string_view part : parts) {
    const std::optional<double> value = checkedNumber(part, range, section, key);
    if (!value) return fallback;
    values.push_back(*value);
  }
  return values;
}

void IniDocument::problem(const std::string& section, const std::string& key, const std::string& what) {
  note(lineOf(section, key), section, key, what);
}

void IniDocument::note(int line, const std::string& section, const std::string& key, std::string what) {
  problems_.push_back({line, section, key, std::move(what)});
}

int IniDocument::lineOf(const std::string& section, const std::string& key) const {
  if (has(section, key)) return position(section, key);
  const auto header = section_lines_.find(section);
  return header == section_lines_.end() ? 0 : header->second;
}

std::string IniDocument::unknownKey(const std::string& section, const std::string& key) const {
  std::vector<std::string> keys;
  std::string elsewhere;
  for (const auto& [known_section, known_key] : known_) {
    if (known_section == section) keys.push_back(known_key);
    if (known_key == key && elsewhere.empty()) elsewhere = "[" + known_section + "] " + known_key;
  }
  const std::string near = ini::nearest(key, keys);
  return "unknown key" + didYouMean(near.empty() ? elsewhere : near);
}

std::vector<IniDocument::Problem> IniDocument::unknownNames() const {
  std::vector<std::string> known_sections;
  for (const auto& [section, key] : known_) {
    if (known_sections.empty() || known_sections.back() != section) known_sections.push_back(section);
  }
  const auto isKnown = [&](const std::string& section) {
    return std::binary_search(known_sections.begin(), known_sections.end(), section);
  };
  std::vector<Problem> unknown;
  for (const auto& [section, line] : section_lines_) {
    if (isKnown(section) || unknown.size() > max_problems) continue;
    const std::string near = ini::nearest(section, known_sections);
    unknown.push_back(
        {line, section, "", "unknown section" + didYouMean(near.empty() ? "" : "[" + near + "]")});
  }
  for (const auto& [name, entry] : entries_) {
    if (entry.used || !isKnown(name.first) || unknown.size() > max_problems) continue;
    unknown.push_back({entry.line, name.first, name.second, unknownKey(name.first, name.second)});
  }
  return unknown;
}

std::string IniDocument::message(const Problem& problem) const {
  std::string text = problem.line == from_set ? "--set" : ini::escaped(name_);
  if (problem.line > 0 && problem.line != from_set) text += ":" + std::to_string(problem.line);
  text += ":";
  if (!problem.section.empty()) text += " [" + ini::escaped(problem.section, ini::longest_shown) + "]";
  if (!problem.key.empty()) text += " " + ini::escaped(problem.key, ini::longest_shown);
  if (!problem.section.empty() || !problem.key.empty()) text += ":";
  return text + " " + problem.what;
}

void IniDocument::finish() const {
  std::vector<Problem> all = problems_;
  const std::vector<Problem> unknown = unknownNames();
  all.insert(all.end(), unknown.begin(), unknown.end());
  if (all.empty()) return;
  std::stable_sort(all.begin(), all.end(),
                   [](const Problem& a, const Problem& b) { return a.line < b.line; });
  std::string text;
  for (std::size_t i = 0; i < std::min(all.size(), max_problems); ++i) {
    text += (i == 0 ? "" : "\n") + message(all[i]);
  }
  if (all.size() > max_problems) text += "\n" + ini::escaped(name_) + ": and more problems";
  throw ConfigError(text);
}

}  // namespace hoctomap
