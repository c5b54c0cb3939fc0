// SPDX-License-Identifier: BSD-3-Clause
#include "Page.h"

#include <zlib.h>

#include <array>
#include <cstdint>
#include <utility>

#include "PageText.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {

namespace {

/// As a zlib stream, which every browser undoes with DecompressionStream("deflate").
std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  const int status =
      compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), Z_BEST_COMPRESSION);
  if (status != Z_OK) throw LimitError("a block of the report cannot be compressed");
  out.resize(size);
  return out;
}

void appendBase64(std::string& text, std::string_view bytes) {
  static constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  text.reserve(text.size() + (bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      word = word << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : kDigits[word >> (18U - 6U * k) & 63U];
    }
  }
}

std::string htmlText(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

}  // namespace

Page::Page(std::string_view title) {
  if (kPageHead.empty()) {
    throw FileError(
        "this program was built without the page of reports: run scripts/install_dependencies.sh "
        "(it needs npm), then build anew");
  }
  html_ = std::string(kPageHead) + "<title>" + htmlText(title) + "</title>\n";
}

void Page::add(std::string_view name, std::string_view bytes) {
  html_ += "<script type=\"application/octet-stream\" id=\"" + std::string(name) + "\">";
  appendBase64(html_, deflated(bytes));
  html_ += "</script>\n";
}

void Page::addJson(std::string_view name, const nlohmann::ordered_json& json) {
  // Labels and paths may be no UTF-8.
  add(name, std::string_view(json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)));
}

std::string Page::html() && {
  return std::move(html_.append(kPageTail));
}

}  // namespace hoctomap
