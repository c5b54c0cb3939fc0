// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/EscapedText.h"

namespace hoctomap {

namespace {

void appendHex(std::string& out, unsigned char byte) {
  constexpr char digits[] = "0123456789abcdef";
  out += "\\x";
  out += digits[byte >> 4];
  out += digits[byte & 15];
}

/// Length of the well-formed, printable, multi-byte UTF-8 character at `at`, or 0.
std::size_t printableMultibyte(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[at + i]); };
  const unsigned char lead = byte(0);
  const std::size_t length = lead >= 0xC2 && lead < 0xE0   ? 2
                             : (lead & 0xF0) == 0xE0       ? 3
                             : lead >= 0xF0 && lead < 0xF5 ? 4
                                                           : 0;
  if (length == 0 || at + length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  const bool c1_control = lead == 0xC2 && byte(1) < 0xA0;
  const bool direction_mark = lead == 0xE2 && byte(1) == 0x80;  // U+2000..U+203F holds the bidi overrides
  const bool overlong_or_surrogate = (lead == 0xE0 && byte(1) < 0xA0) || (lead == 0xED && byte(1) >= 0xA0) ||
                                     (lead == 0xF0 && byte(1) < 0x90) || (lead == 0xF4 && byte(1) >= 0x90);
  return c1_control || direction_mark || overlong_or_surrogate ? 0 : length;
}

}  // namespace

std::string escapedText(std::string_view text, std::size_t max_bytes) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    if (out.size() >= max_bytes) return out + "...";
    const auto c = static_cast<unsigned char>(text[i]);
    if (const std::size_t length = c >= 0x80 ? printableMultibyte(text, i) : 0; length > 0) {
      out += text.substr(i, length);
      i += length;
      continue;
    }
    if (c == '\n') {
      out += "\\n";
    } else if (c == '\t') {
      out += "\\t";
    } else if (c < 0x20 || c >= 0x7F) {
      appendHex(out, c);
    } else {
      out += text[i];
    }
    ++i;
  }
  return out;
}

}  // namespace hoctomap
