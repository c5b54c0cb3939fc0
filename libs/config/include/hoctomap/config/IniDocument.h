// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hoctomap {

/// Bounds of a number; a bound belongs to the range unless it is open.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool open_min = false;
  bool open_max = false;

  [[nodiscard]] bool contains(double value) const;
  /// For people: `> 0.5 and < 1`, `>= 0`, `any`.
  [[nodiscard]] std::string text() const;
};

/// Strict reading of an INI file. Every value that is read is checked in full; what is wrong is collected, so
/// that the user sees all problems of a file at once. Usage: construct, read every key, then `finish()`.
///
/// Problems: lines that are no INI, unknown and duplicate keys or sections, wrong types (`12junk`), values
/// that are not finite or out of range. Keys that nobody has read when `finish()` is called are unknown; the
/// nearest known key is suggested. Names are case-sensitive. A comment starts with `;`, `#` or `//`, at the
/// beginning of a line or after a blank.
class IniDocument {
 public:
  /// @throws ConfigError if the file cannot be read, is no regular file or is larger than 1 MB.
  [[nodiscard]] static IniDocument fromFile(const std::filesystem::path& path);
  /// `name` stands for the file in messages.
  [[nodiscard]] static IniDocument fromText(std::string_view text, std::string name);

  /// `section.key=value`; the last dot before the first `=` separates the key. Replaces or adds.
  /// @throws ConfigError if the text has not this form.
  void set(std::string_view assignment);

  /// Names of the sections in the order of the file, each once.
  [[nodiscard]] std::vector<std::string> sections() const { return sections_; }
  [[nodiscard]] bool hasSection(const std::string& section) const;
  [[nodiscard]] bool has(const std::string& section, const std::string& key) const;

  /// Where a value was given, to tell which of two came later: 0 if absent, else its line; those of `set`
  /// last.
  [[nodiscard]] int position(const std::string& section, const std::string& key) const;

  // Each returns `fallback` when the key is absent, and when it is wrong (after noting the problem).
  double number(const std::string& section, const std::string& key, double fallback, Range range);
  /// As `number`; the word `none` gives nothing.
  std::optional<double> numberOrNone(const std::string& section, const std::string& key,
                                     std::optional<double> fallback, Range range);
  std::int64_t integer(const std::string& section, const std::string& key, std::int64_t fallback,
                       Range range);
  /// `true` or `false`.
  bool boolean(const std::string& section, const std::string& key, bool fallback);
  std::string text(const std::string& section, const std::string& key, const std::string& fallback);
  /// One of `choices`.
  std::string choice(const std::string& section, const std::string& key, const std::string& fallback,
                     const std::vector<std::string>& choices);
  /// Numbers separated by blanks and/or commas; exactly `count` of them if given.
  std::vector<double> numbers(const std::string& section, const std::string& key,
                              const std::vector<double>& fallback, std::optional<std::size_t> count,
                              Range range);

  /// Notes a problem found by the caller, for example keys that contradict each other. `key` and `section`
  /// may be empty: the problem is then that of the section, of the file.
  void problem(const std::string& section, const std::string& key, const std::string& what);

  /// @throws ConfigError naming every problem (at most 100), one a line, in the order of the file:
  /// `FILE:LINE: [section] key: what`, without LINE where there is none, with `--set` in the place of
  /// `FILE:LINE` for values that came from there.
  void finish() const;

 private:
  struct Entry {
    std::string value;
    int line = 0;  // of the file; from_set where there is none because `set` gave the value
    bool used = false;
  };
  struct Problem {
    int line;
    std::string section;
    std::string key;
    std::string what;
  };
  using Name = std::pair<std::string, std::string>;  // section, key
  static constexpr int from_set = std::numeric_limits<int>::max();

  void parse(std::string_view text);
  void parseLine(std::string_view line, int number, std::string& section);
  void openSection(const std::string& section, int line);
  void note(int line, const std::string& section, const std::string& key, std::string what);
  [[nodiscard]] std::string message(const Problem& problem) const;
  [[nodiscard]] int lineOf(const std::string& section, const std::string& key) const;
  [[nodiscard]] std::vector<Problem> unknownNames() const;
  [[nodiscard]] std::string unknownKey(const std::string& section, const std::string& key) const;
  Entry* ask(const std::string& section, const std::string& key);
  std::optional<double> checkedNumber(std::string_view text, Range range, const std::string& section,
                                      const std::string& key);

  std::string name_;
  std::map<Name, Entry> entries_;
  std::vector<std::string> sections_;
  std::map<std::string, int> section_lines_;
  std::vector<Problem> problems_;
  std::set<Name> known_;  // names asked for: what `finish` suggests from
};

}  // namespace hoctomap
