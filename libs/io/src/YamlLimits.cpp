// SPDX-License-Identifier: BSD-3-Clause
#include "YamlLimits.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "hoctomap/geometry/Errors.h"

namespace hoctomap {
namespace {

constexpr std::size_t kMaxBrackets = 4;  // a manifest has two

/// Where the quoted text ends whose opening quote is at `at`: the index of the closing one, or the text's
/// end.
std::size_t endOfQuoted(std::string_view text, std::size_t at) {
  const char quote = text[at];
  for (++at; at < text.size() && text[at] != quote; ++at) {
    if (quote == '"' && text[at] == '\\') ++at;
  }
  return at;
}

}  // namespace

void requireSimpleYaml(std::string_view text, const std::string& name) {
  std::size_t line = 1;
  std::size_t brackets = 0;
  bool begins = true;  // whether a value may begin here
  const auto refuse = [&](const std::string& what) {
    throw MapError(name + ": line " + std::to_string(line) + ": " + what);
  };
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (begins && (c == '"' || c == '\'')) {
      at = endOfQuoted(text, at);
    } else if (begins && c == '#') {
      at = std::min(text.find('\n', at), text.size()) - 1;
    } else if (begins && (c == '&' || c == '*')) {
      refuse("a map has no anchors and aliases");
    } else if (begins && (c == '[' || c == '{') && ++brackets > kMaxBrackets) {
      refuse("brackets in brackets, more than a map has");
    } else if ((c == ']' || c == '}') && brackets > 0) {
      --brackets;
    }
    if (c == '\n') ++line;
    begins = c == ' ' || c == '\n' || c == '[' || c == '{' || c == ',';
  }
}

}  // namespace hoctomap
