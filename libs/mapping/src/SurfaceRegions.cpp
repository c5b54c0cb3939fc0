// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceRegions.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "CellKey.h"
#include "RegionMerging.h"
#include "hoctomap/geometry/ForEachIndex.h"

namespace hoctomap {

namespace {

using Cell = SeamVotes::Cell;
using Index = CellIndex;

struct CellBorder {
  Index a;
  Index b;
  SeamBorder border;
};

/// The cells of objects around `seeds`, in order, and which of them have a border: those that some scan has
/// shown together, and neighbours.
class CellGraph {
 public:
  CellGraph(const SeamVotes& votes, const SeamVotes::Cells& seeds) {
    for (const SeamVotes::Entry* entry : votes.objectsAround(seeds)) {
      cells_.push_back(entry->first);
      votes_.push_back(&entry->second);
    }
  }

  [[nodiscard]] Index size() const { return static_cast<Index>(cells_.size()); }
  [[nodiscard]] const Cell& cell(Index i) const { return cells_[i]; }
  [[nodiscard]] std::optional<Index> find(const Cell& cell) const {
    const auto found = std::lower_bound(cells_.begin(), cells_.end(), cell);
    if (found == cells_.end() || *found != cell) return std::nullopt;
    return static_cast<Index>(found - cells_.begin());
  }

  /// Each from one of its sides only; several of the same two add up.
  [[nodiscard]] std::vector<CellBorder> borders() const {
    // Neighbours are one unless scans say otherwise: views drift apart by a cell.
    constexpr SeamBorder kNeighbours{-1, 1};
    std::vector<CellBorder> borders;
    for (std::size_t d = 0; d < SeamVotes::kDirections; ++d) {
      forCellPairs(cells_, SeamVotes::partner({}, d), [&](Index i, Index j) {
        if (votes_[i]->known[d]) borders.push_back({i, j, {votes_[i]->evidence[d], 1}});
      });
    }
    for (int step = 14; step < 27; ++step) {  // half of the 26 neighbours
      forCellPairs(cells_, {step / 9 - 1, step / 3 % 3 - 1, step % 3 - 1}, [&](Index i, Index j) {
        borders.push_back({i, j, kNeighbours});
      });
    }
    return borders;
  }

 private:
  std::vector<Cell> cells_;
  std::vector<const SeamVotes::Votes*> votes_;
};

/// The cells that hang together, in order, of every group that holds one of `seeds`.
std::vector<std::vector<Index>> groups(const CellGraph& graph, const std::vector<CellBorder>& borders,
                                       const SeamVotes::Cells& seeds) {
  std::vector<Index> parent(graph.size());
  std::iota(parent.begin(), parent.end(), Index{0});
  const auto root = [&](Index i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const CellBorder& border : borders) parent[root(border.a)] = root(border.b);
  std::map<Index, std::vector<Index>> of_root;
  for (const Cell& seed : seeds) {
    if (const auto i = graph.find(seed)) of_root[root(*i)];
  }
  for (Index i = 0; i < graph.size(); ++i) {
    const auto found = of_root.find(root(i));
    if (found != of_root.end()) found->second.push_back(i);
  }
  std::vector<std::vector<Index>> found;
  for (auto& [i, cells] : of_root) found.push_back(std::move(cells));
  return found;
}

/// A cell of a group.
struct Place {
  std::size_t group;
  Index cell;
};

}  // namespace

SurfaceRegions::SurfaceRegions(const SeamVotes& votes, const SeamVotes::Cells& seeds) {
  const CellGraph graph(votes, seeds);
  const std::vector<CellBorder> borders = graph.borders();
  std::vector<std::optional<Place>> places(graph.size());
  std::vector<RegionMerging> mergings;
  for (const auto& group : groups(graph, borders, seeds)) {
    std::vector<Cell> cells;
    for (const Index i : group) {
      places[i] = Place{mergings.size(), static_cast<Index>(cells.size())};
      cells.push_back(graph.cell(i));
    }
    mergings.emplace_back(std::move(cells));
  }
  for (const auto& [a, b, border] : borders) {
    if (places[a]) mergings[places[a]->group].addBorder(places[a]->cell, places[b]->cell, border);
  }
  forEachIndex(mergings.size(), [&](std::size_t k) {
    mergings[k].mergeWhatIsOne();
    mergings[k].absorbFragments();
    mergings[k].joinParts();
    mergings[k].joinCarriers();
  });

  std::vector<std::map<Index, Region>> number(mergings.size());  // by group and root
  for (Index i = 0; i < graph.size(); ++i) {
    if (!places[i]) continue;
    auto& [group, cell] = *places[i];
    const auto [found, is_new] =
        number[group].try_emplace(mergings[group].regionOf(cell), static_cast<Region>(sizes_.size()));
    if (is_new) sizes_.push_back(0);
    ++sizes_[found->second];
    region_of_cell_[cellKey(graph.cell(i))] = found->second;
  }
  for (std::size_t group = 0; group < mergings.size(); ++group) {
    for (const auto& [root, region] : number[group]) {
      for (const auto& [other, border] : mergings[group].bordersOf(root))
        seams_.insert(std::minmax(region, number[group].at(other)));
    }
  }
}

std::optional<SurfaceRegions::Region> SurfaceRegions::at(const SeamVotes::Cell& cell) const {
  const auto found = region_of_cell_.find(cellKey(cell));
  return found == region_of_cell_.end() ? std::nullopt : std::optional(found->second);
}

bool SurfaceRegions::isBeside(const SeamVotes::Cell& c, Region region) const {
  for (int step = 0; step < 27; ++step) {
    if (at({c.x + step / 9 - 1, c.y + step / 3 % 3 - 1, c.z + step % 3 - 1}) == region) return true;
  }
  return false;
}

}  // namespace hoctomap
