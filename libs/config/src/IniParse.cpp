// SPDX-License-Identifier: BSD-3-Clause
// The text side of IniDocument: files, lines, assignments.
#include <algorithm>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include "IniText.h"
#include "hoctomap/config/IniDocument.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {
namespace {

constexpr std::size_t max_file_bytes = 1'000'000;

std::string readFile(const std::filesystem::path& path) {
  const auto fail = [&](const std::string& what) -> ConfigError {
    return ConfigError(ini::escaped(path.string()) + ": " + what);
  };
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw fail("no such configuration file");
  if (std::filesystem::is_directory(status)) throw fail("is a directory, not a configuration file");
  // A pipe without a writer would block for ever.
  if (!std::filesystem::is_regular_file(status)) throw fail("is no regular file");

  std::ifstream in(path, std::ios::binary);
  if (!in) throw fail("cannot be opened for reading");
  std::string text(max_file_bytes + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) throw fail("cannot be read");
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() > max_file_bytes) throw fail("is larger than 1 MB, so it is no configuration file");
  return text;
}

}  // namespace

IniDocument IniDocument::fromFile(const std::filesystem::path& path) {
  return fromText(readFile(path), path.string());
}

IniDocument IniDocument::fromText(std::string_view text, std::string name) {
  IniDocument document;
  document.name_ = std::move(name);
  document.parse(text);
  return document;
}

void IniDocument::parse(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());

  std::string section;
  for (int number = 1; !text.empty(); ++number) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    line = ini::trimmed(ini::withoutComment(line));
    if (!line.empty()) parseLine(line, number, section);
  }
}

void IniDocument::parseLine(std::string_view line, int number, std::string& section) {
  if (line.front() == '[') {
    const std::size_t end = std::min(line.find(']'), line.size());
    const std::string name(ini::trimmed(line.substr(1, end - 1)));
    // What follows a broken header is still read as that section's: one mistake, one problem.
    if (end + 1 != line.size() || name.empty()) note(number, "", "", ini::quoted(line) + " is no [section]");
    section = name;
    if (name.empty()) return;
    return openSection(section, number);
  }
  const std::size_t equals = line.find('=');
  const std::string key(ini::trimmed(line.substr(0, equals)));
  if (equals == std::string_view::npos || key.empty()) {
    return note(number, section, "", ini::quoted(line) + " is neither [section] nor key = value");
  }
  if (section.empty()) return note(number, "", key, "stands in no [section]");

  const Entry entry{std::string(ini::trimmed(line.substr(equals + 1))), number};
  const auto [old, added] = entries_.try_emplace({section, key}, entry);
  if (!added) note(number, section, key, "duplicate, first in line " + std::to_string(old->second.line));
}

void IniDocument::openSection(const std::string& section, int line) {
  const auto [old, added] = section_lines_.try_emplace(section, line);
  if (added) {
    sections_.push_back(section);
  } else if (line != from_set) {
    note(line, section, "", "duplicate section, first in line " + std::to_string(old->second));
  }
}

void IniDocument::set(std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  const std::string_view name = assignment.substr(0, equals);
  const std::size_t dot = name.rfind('.');
  const bool complete = equals != std::string_view::npos && dot != std::string_view::npos;
  const std::string section(ini::trimmed(complete ? name.substr(0, dot) : ""));
  const std::string key(ini::trimmed(complete ? name.substr(dot + 1) : ""));
  if (section.empty() || key.empty()) {
    throw ConfigError("--set " + ini::quoted(assignment) + ": expected section.key=value");
  }
  openSection(section, from_set);
  entries_[{section, key}] = Entry{std::string(ini::trimmed(assignment.substr(equals + 1))), from_set};
}

}  // namespace hoctomap
