// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/mapping/SeamVotes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace hoctomap {

namespace {

using Cell = SeamVotes::Cell;

/// Half of the directions to the neighbours; the others are their opposites.
constexpr std::array<Cell, 13> kDirections{{{0, 0, 1},
                                            {0, 1, -1},
                                            {0, 1, 0},
                                            {0, 1, 1},
                                            {1, -1, -1},
                                            {1, -1, 0},
                                            {1, -1, 1},
                                            {1, 0, -1},
                                            {1, 0, 0},
                                            {1, 0, 1},
                                            {1, 1, -1},
                                            {1, 1, 0},
                                            {1, 1, 1}}};

Cell partner(const Cell& cell, const Cell& direction, int sign) {
  constexpr int kStep = 2;
  return {cell.x + sign * kStep * direction.x, cell.y + sign * kStep * direction.y,
          cell.z + sign * kStep * direction.z};
}

void count(std::uint16_t& counter) {
  if (counter < std::numeric_limits<std::uint16_t>::max()) ++counter;
}

/// The segment that has most points in a cell, of every cell.
std::map<Cell, std::size_t> ownersOf(std::span<const PointCloud* const> segments) {
  constexpr std::size_t kLeastPoints = 3;  // in a cell: fewer may be strays
  std::vector<std::pair<Cell, std::size_t>> points;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    for (const auto& p : *segments[s]) points.emplace_back(SeamVotes::cellOf(p), s);
  }
  std::sort(points.begin(), points.end());
  std::map<Cell, std::size_t> owners;
  std::size_t most = 0;  // points of the owner of the last cell
  for (auto it = points.begin(); it != points.end();) {
    const auto end = std::upper_bound(it, points.end(), *it);
    const auto here = static_cast<std::size_t>(end - it);
    const bool is_new_cell = owners.empty() || owners.rbegin()->first != it->first;
    if (here >= kLeastPoints && (is_new_cell || here > most)) {
      owners.insert_or_assign(owners.end(), it->first, it->second);
      most = here;
    }
    it = end;
  }
  return owners;
}

}  // namespace

SeamVotes::Cell SeamVotes::cellOf(const Eigen::Vector3f& world_point) {
  const Eigen::Array3i cell = (world_point / kCell).array().floor().cast<int>();
  return {cell.x(), cell.y(), cell.z()};
}

SeamVotes::Cells SeamVotes::cellsOf(std::span<const Eigen::Vector3f> world_points) {
  std::vector<Cell> cells;
  cells.reserve(world_points.size());
  for (const auto& p : world_points) cells.push_back(cellOf(p));
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return {cells.begin(), cells.end()};
}

void SeamVotes::add(std::span<const PointCloud* const> segments) {
  const auto owners = ownersOf(segments);
  for (const auto& [cell, owner] : owners) {
    Votes& votes = votes_[cell];
    count(votes.shown);
    for (std::size_t d = 0; d < kDirections.size(); ++d) {
      const auto other = owners.find(partner(cell, kDirections[d], 1));
      if (other != owners.end() && other->second != owner) count(votes.cut[d]);
    }
  }
}

void SeamVotes::forget(const Cells& cells) {
  for (const Cell& cell : cells) votes_.erase(cell);
}

void SeamVotes::assume(const Cells& cells, std::uint16_t scans) {
  for (const Cell& cell : cells) votes_[cell] = Votes{scans, {}};
}

SeamVotes::Verdict SeamVotes::between(const Cells& a, const Cells& b) const {
  Verdict verdict;
  for (const Cell& cell : a) {
    const auto here = votes_.find(cell);
    if (here == votes_.end()) continue;
    for (std::size_t d = 0; d < kDirections.size(); ++d) {
      for (const int sign : {1, -1}) {
        const Cell other = partner(cell, kDirections[d], sign);
        if (!b.contains(other)) continue;
        const auto there = votes_.find(other);
        if (there == votes_.end()) continue;
        const double cut = sign > 0 ? here->second.cut[d] : there->second.cut[d];
        const double both = std::min(here->second.shown, there->second.shown);
        verdict.apart += cut;
        verdict.joined += std::max(0.0, both - cut);
        verdict.pairs += 1.0;
      }
    }
  }
  return verdict;
}

}  // namespace hoctomap
