// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "hoctomap/mapping/SeamVotes.h"

namespace hoctomap {

/// The surface that scans have shown, taken apart into things by their votes (docs/decisions/0028): the two
/// regions that most speaks for being one are joined, until nothing speaks for joining any two. It depends on
/// the votes only, not on the order in which they came.
class SurfaceRegions {
 public:
  using Region = std::uint32_t;

  /// Of all that hangs together with `seeds`.
  SurfaceRegions(const SeamVotes& votes, const SeamVotes::Cells& seeds);

  [[nodiscard]] std::optional<Region> at(const SeamVotes::Cell& cell) const;
  /// Whether a cell around this one, or this one, is in a region.
  [[nodiscard]] bool isBeside(const SeamVotes::Cell& cell, Region region) const;
  [[nodiscard]] std::size_t count() const { return sizes_.size(); }
  /// Number of cells.
  [[nodiscard]] std::size_t size(Region region) const { return sizes_[region]; }
  /// Whether two regions have a seam.
  [[nodiscard]] bool meet(Region a, Region b) const { return seams_.contains(std::minmax(a, b)); }

 private:
  std::unordered_map<std::uint64_t, Region> region_of_cell_;
  std::vector<std::size_t> sizes_;
  std::set<std::pair<Region, Region>> seams_;
};

/// Fewer cells (27 cm^2) have too little of a border to be judged by.
constexpr std::size_t kFragmentCells = 12;

}  // namespace hoctomap
