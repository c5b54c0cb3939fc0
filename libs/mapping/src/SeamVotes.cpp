// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/mapping/SeamVotes.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "hoctomap/mapping/ScanSeams.h"

namespace hoctomap {

namespace {

using Cell = SeamVotes::Cell;

/// The cells two steps away along some axis, one of each opposite two.
std::array<Cell, SeamVotes::kDirections> directions() {
  std::array<Cell, SeamVotes::kDirections> found;
  std::size_t n = 0;
  for (std::int32_t x = -2; x <= 2; ++x) {
    for (std::int32_t y = -2; y <= 2; ++y) {
      for (std::int32_t z = -2; z <= 2; ++z) {
        const bool is_two_away = std::max({std::abs(x), std::abs(y), std::abs(z)}) == 2;
        if (is_two_away && Cell{x, y, z} > Cell{}) found[n++] = {x, y, z};
      }
    }
  }
  return found;
}

const auto kDirection = directions();

}  // namespace

SeamVotes::Cell SeamVotes::cellOf(const Eigen::Vector3f& world_point) {
  const Eigen::Array3i cell = (world_point / kCell).array().floor().cast<int>();
  return {cell.x(), cell.y(), cell.z()};
}

SeamVotes::Cells SeamVotes::cellsOf(std::span<const Eigen::Vector3f> world_points) {
  std::vector<Cell> cells;
  cells.reserve(world_points.size());
  for (const auto& p : world_points) {
    const Cell cell = cellOf(p);
    if (cells.empty() || cells.back() != cell) cells.push_back(cell);  // neighbours often share one
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return {cells.begin(), cells.end()};
}

SeamVotes::Cell SeamVotes::partner(const Cell& cell, std::size_t direction, int sign) {
  const Cell& d = kDirection[direction];
  return {cell.x + sign * d.x, cell.y + sign * d.y, cell.z + sign * d.z};
}

SeamVotes::Cells SeamVotes::add(const ScanSeams& scan) {
  constexpr int kMost = 1000;
  std::vector<Votes*> votes;
  votes.reserve(scan.cells.size());
  Cells shown;
  for (std::size_t i = 0; i < scan.cells.size(); ++i) {
    votes.push_back(&votes_[scan.cells[i]]);
    if (!scan.is_object[i]) continue;
    shown.insert(shown.end(), scan.cells[i]);
    votes.back()->is_object = true;
  }
  for (const auto& [cell, direction, evidence] : scan.pairs) {
    votes[cell]->known.set(direction);
    std::int16_t& sum = votes[cell]->evidence[direction];
    sum = static_cast<std::int16_t>(std::clamp(sum + evidence, -kMost, kMost));
  }
  return shown;
}

void SeamVotes::forget(const Cells& cells) {
  for (const Cell& cell : cells) {
    votes_.erase(cell);
    for (std::size_t d = 0; d < kDirections; ++d) {
      const auto other = votes_.find(partner(cell, d, -1));
      if (other == votes_.end()) continue;
      other->second.known.reset(d);
      other->second.evidence[d] = 0;
    }
  }
}

void SeamVotes::assume(const Cells& cells) {
  constexpr std::int16_t kWhole = -6;  // three scans that join what is smooth
  forget(cells);
  for (const Cell& cell : cells) {
    Votes& votes = votes_[cell];
    votes.is_object = true;
    for (std::size_t d = 0; d < kDirections; ++d) {
      if (!cells.contains(partner(cell, d))) continue;
      votes.known.set(d);
      votes.evidence[d] = kWhole;
    }
  }
}

bool SeamVotes::meet(const Cells& a, const Cells& b) const {
  const auto reaches = [this](const Cells& from, const Cells& to) {
    return std::any_of(from.begin(), from.end(), [&](const Cell& cell) {
      const auto found = votes_.find(cell);
      if (found == votes_.end()) return false;
      for (std::size_t d = 0; d < kDirections; ++d) {
        if (found->second.known[d] && to.contains(partner(cell, d))) return true;
      }
      return false;
    });
  };
  return reaches(a, b) || reaches(b, a);
}

std::vector<const SeamVotes::Entry*> SeamVotes::objectsAround(const Cells& seeds) const {
  // By columns of 16 x 16 cells: what hangs together reaches two cells far, so it never jumps over an empty
  // one.
  constexpr int kShift = 4;
  using Column = std::pair<std::int32_t, std::int32_t>;
  std::set<Column> known;
  std::vector<Column> open;
  const auto enter = [&](const Column& column) {
    if (known.insert(column).second) open.push_back(column);
  };
  for (const Cell& seed : seeds) enter({seed.x >> kShift, seed.y >> kShift});
  std::vector<const Entry*> found;
  while (!open.empty()) {
    const auto [column_x, column_y] = open.back();
    open.pop_back();
    const std::size_t before = found.size();
    for (std::int32_t x = column_x << kShift; x >> kShift == column_x; ++x) {
      auto entry = votes_.lower_bound({x, column_y << kShift, std::numeric_limits<std::int32_t>::min()});
      for (; entry != votes_.end() && entry->first.x == x && entry->first.y >> kShift == column_y; ++entry) {
        if (entry->second.is_object) found.push_back(&*entry);
      }
    }
    if (found.size() == before) continue;
    for (const std::int32_t dx : {-1, 0, 1}) {
      for (const std::int32_t dy : {-1, 0, 1}) enter({column_x + dx, column_y + dy});
    }
  }
  std::sort(found.begin(), found.end(), [](const Entry* a, const Entry* b) { return a->first < b->first; });
  return found;
}

}  // namespace hoctomap
