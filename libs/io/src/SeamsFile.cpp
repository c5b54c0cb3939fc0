// SPDX-License-Identifier: BSD-3-Clause
#include "SeamsFile.h"

#include <array>
#include <charconv>
#include <limits>
#include <optional>
#include <string_view>

#include "hoctomap/geometry/Errors.h"

namespace hoctomap {
namespace {

std::string header() {
  std::string text = "x,y,z,object";
  for (std::size_t d = 0; d < SeamVotes::kDirections; ++d) text += ",e" + std::to_string(d);
  return text + '\n';
}

/// Reads one number and the separator behind it; nothing where no number stands.
std::optional<std::int32_t> take(std::string_view& row, char separator, const std::string& where) {
  std::optional<std::int32_t> number;
  std::size_t length = 0;
  if (!row.empty() && row.front() != separator) {
    const auto [end, error] = std::from_chars(row.data(), row.data() + row.size(), number.emplace());
    length = static_cast<std::size_t>(end - row.data());
    if (error != std::errc()) throw MapError(where + ": is no row of seam votes");
  }
  if (length >= row.size() || row[length] != separator) throw MapError(where + ": is no row of seam votes");
  row.remove_prefix(length + 1);
  return number;
}

std::int32_t takeIndex(std::string_view& row, const std::string& where) {
  const auto index = take(row, ',', where);
  if (!index) throw MapError(where + ": is no row of seam votes");
  return *index;
}

}  // namespace

std::string seamsText(const SeamVotes& seams) {
  std::string text = header();
  const auto put = [&text](std::int32_t number) {
    std::array<char, 12> digits{};
    text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
  };
  for (const auto& [cell, votes] : seams.all()) {
    for (const std::int32_t index : {cell.x, cell.y, cell.z}) {
      put(index);
      text += ',';
    }
    text += votes.is_object ? '1' : '0';
    for (std::size_t d = 0; d < SeamVotes::kDirections; ++d) {
      text += ',';
      if (votes.known[d]) put(votes.evidence[d]);
    }
    text += '\n';
  }
  return text;
}

SeamVotes parseSeams(const std::string& text, const std::string& name) {
  std::string_view rest = text;
  if (!rest.starts_with(header())) throw MapError(name + ":1: is no table of seam votes");
  rest.remove_prefix(header().size());
  SeamVotes seams;
  for (std::size_t line = 2; !rest.empty(); ++line) {
    const std::string where = name + ":" + std::to_string(line);
    SeamVotes::Cell cell;
    cell.x = takeIndex(rest, where);
    cell.y = takeIndex(rest, where);
    cell.z = takeIndex(rest, where);
    SeamVotes::Votes votes;
    const std::int32_t is_object = takeIndex(rest, where);
    if (is_object != 0 && is_object != 1) throw MapError(where + ": is no row of seam votes");
    votes.is_object = is_object == 1;
    for (std::size_t d = 0; d < SeamVotes::kDirections; ++d) {
      const auto evidence = take(rest, d + 1 < SeamVotes::kDirections ? ',' : '\n', where);
      if (!evidence) continue;
      if (*evidence < std::numeric_limits<std::int16_t>::min() ||
          *evidence > std::numeric_limits<std::int16_t>::max())
        throw MapError(where + ": is no row of seam votes");
      votes.known.set(d);
      votes.evidence[d] = static_cast<std::int16_t>(*evidence);
    }
    seams.set(cell, votes);
  }
  return seams;
}

}  // namespace hoctomap
