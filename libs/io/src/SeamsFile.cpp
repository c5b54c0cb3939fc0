// SPDX-License-Identifier: BSD-3-Clause
#include "SeamsFile.h"

#include <charconv>
#include <string_view>

#include "hoctomap/geometry/Errors.h"

namespace hoctomap {
namespace {

constexpr std::string_view kHeader =
    "x,y,z,shown,cut0,cut1,cut2,cut3,cut4,cut5,cut6,cut7,cut8,cut9,cut10,cut11,cut12\n";

/// Reads one number and the separator behind it.
template <typename Number>
Number take(std::string_view& row, char separator, const std::string& where) {
  Number number{};
  const auto [end, error] = std::from_chars(row.data(), row.data() + row.size(), number);
  const auto length = static_cast<std::size_t>(end - row.data());
  if (error != std::errc() || length >= row.size() || row[length] != separator) {
    throw MapError(where + ": is no row of seam votes");
  }
  row.remove_prefix(length + 1);
  return number;
}

}  // namespace

std::string seamsText(const SeamVotes& seams) {
  std::string text(kHeader);
  for (const auto& [cell, votes] : seams.all()) {
    for (const auto index : {cell.x, cell.y, cell.z}) text += std::to_string(index) + ",";
    text += std::to_string(votes.shown);
    for (const auto cut : votes.cut) text += "," + std::to_string(cut);
    text += '\n';
  }
  return text;
}

SeamVotes parseSeams(const std::string& text, const std::string& name) {
  std::string_view rest = text;
  if (!rest.starts_with(kHeader)) throw MapError(name + ":1: is no table of seam votes");
  rest.remove_prefix(kHeader.size());
  SeamVotes seams;
  for (std::size_t line = 2; !rest.empty(); ++line) {
    const std::string where = name + ":" + std::to_string(line);
    SeamVotes::Cell cell;
    cell.x = take<std::int32_t>(rest, ',', where);
    cell.y = take<std::int32_t>(rest, ',', where);
    cell.z = take<std::int32_t>(rest, ',', where);
    SeamVotes::Votes votes;
    votes.shown = take<std::uint16_t>(rest, ',', where);
    for (std::size_t d = 0; d < votes.cut.size(); ++d)
      votes.cut[d] = take<std::uint16_t>(rest, d + 1 < votes.cut.size() ? ',' : '\n', where);
    seams.set(cell, votes);
  }
  return seams;
}

}  // namespace hoctomap
