// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceRegions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <queue>
#include <utility>

#include "CellKey.h"
#include "hoctomap/geometry/ForEachIndex.h"

namespace hoctomap {

namespace {

using Cell = SeamVotes::Cell;
using Index = std::uint32_t;

/// What speaks for and against a seam along a border.
struct Border {
  int evidence = 0;  ///< positive: for two things
  int pairs = 0;

  void add(const Border& other) {
    evidence += other.evidence;
    pairs += other.pairs;
  }
  /// A sum of `pairs` votes is sure by its ratio to their square root: neither long borders nor short ones
  /// are preferred.
  [[nodiscard]] double certainty() const { return -evidence / std::sqrt(static_cast<double>(pairs)); }
};

struct Candidate {
  double certainty;
  Index a;  ///< a < b
  Index b;
  bool operator<(const Candidate& other) const {
    return certainty != other.certainty ? certainty < other.certainty
                                        : (a != other.a ? a > other.a : b > other.b);
  }
};

/// The borders of one region, in the order of the others: short lists that are walked far more often than
/// changed.
class Borders {
 public:
  struct Entry {
    Index other;
    Border border;
  };

  /// In any order, also several of one other; before anything else `settle` puts them into theirs.
  void append(Index other, const Border& border) { entries_.push_back({other, border}); }
  void settle() {
    std::sort(entries_.begin(), entries_.end(), isBefore);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      if (kept > 0 && entries_[kept - 1].other == entries_[i].other)
        entries_[kept - 1].border.add(entries_[i].border);
      else
        entries_[kept++] = entries_[i];
    }
    entries_.resize(kept);
  }

  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  [[nodiscard]] auto begin() const { return entries_.begin(); }
  [[nodiscard]] auto end() const { return entries_.end(); }
  [[nodiscard]] const Border* find(Index other) const {
    const auto at = std::lower_bound(entries_.begin(), entries_.end(), Entry{other, {}}, isBefore);
    return at != entries_.end() && at->other == other ? &at->border : nullptr;
  }
  /// There is one.
  [[nodiscard]] const Border& at(Index other) const {
    return std::lower_bound(entries_.begin(), entries_.end(), Entry{other, {}}, isBefore)->border;
  }
  void set(Index other, const Border& border) {
    const auto at = std::lower_bound(entries_.begin(), entries_.end(), Entry{other, {}}, isBefore);
    if (at != entries_.end() && at->other == other)
      at->border = border;
    else
      entries_.insert(at, {other, border});
  }
  void erase(Index other) {
    const auto at = std::lower_bound(entries_.begin(), entries_.end(), Entry{other, {}}, isBefore);
    if (at != entries_.end() && at->other == other) entries_.erase(at);
  }
  void clear() { entries_.clear(); }

 private:
  static bool isBefore(const Entry& a, const Entry& b) { return a.other < b.other; }
  std::vector<Entry> entries_;
};

class Merging {
 public:
  explicit Merging(std::vector<Cell> cells) : cells_(std::move(cells)), borders_(cells_.size()) {
    for (Index i = 0; i < cells_.size(); ++i) {
      parent_.push_back(i);
      members_.push_back({i});
    }
  }

  /// All of them, before the rest.
  void addBorder(Index a, Index b, const Border& border) {
    borders_[a].append(b, border);
    borders_[b].append(a, border);
  }

  void mergeWhatIsOne() {
    for (auto& borders : borders_) borders.settle();
    for (Index a = 0; a < borders_.size(); ++a) {
      for (const auto& [b, border] : borders_[a]) {
        if (a < b) propose(a, b, border);
      }
    }
    while (!queue_.empty()) {
      const Candidate top = queue_.top();
      queue_.pop();
      const Border* const border = borders_[top.a].find(top.b);
      if (border == nullptr || border->certainty() != top.certainty) continue;  // outdated
      merge(top.a, top.b);
    }
  }

  /// Small pieces belong to what they are least parted from.
  void absorbFragments() {
    for (bool again = true; again;) {
      again = false;
      for (Index r = 0; r < parent_.size(); ++r) {
        if (!isRegion(r) || members_[r].size() >= kFragmentCells) continue;
        std::optional<Candidate> best;
        for (const auto& [other, border] : borders_[r]) {
          const Candidate c{border.certainty(), std::min(r, other), std::max(r, other)};
          if (!best || *best < c) best = c;
        }
        if (!best) continue;
        merge(best->a, best->b);
        again = true;
      }
    }
  }

  /// A small piece that a larger thing covers or holds is a part of it.
  void joinParts() {
    constexpr double kMostShare = 0.3;
    std::vector<Index> order;
    for (Index r = 0; r < parent_.size(); ++r) {
      if (isRegion(r)) order.push_back(r);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](Index a, Index b) { return members_[a].size() > members_[b].size(); });
    for (const Index whole : order) {
      if (!isRegion(whole)) continue;
      std::vector<Index> pieces;
      for (const auto& [other, border] : borders_[whole]) {
        const double share =
            static_cast<double>(members_[other].size()) / static_cast<double>(members_[whole].size());
        if (share <= kMostShare && isPart(whole, other)) pieces.push_back(other);
      }
      std::sort(pieces.begin(), pieces.end());
      Index kept = whole;
      for (const Index piece : pieces) kept = merge(kept, piece);
    }
  }

  [[nodiscard]] Index regionOf(Index cell) {
    while (parent_[cell] != cell) cell = parent_[cell] = parent_[parent_[cell]];
    return cell;
  }
  [[nodiscard]] const Borders& bordersOf(Index region) const { return borders_[region]; }

 private:
  [[nodiscard]] bool isRegion(Index r) const { return parent_[r] == r; }

  void propose(Index a, Index b, const Border& border) {
    if (border.evidence < 0) queue_.push({border.certainty(), std::min(a, b), std::max(a, b)});
  }

  /// The one with fewer borders goes into the other.
  Index merge(Index a, Index b) {
    if (borders_[a].size() < borders_[b].size()) std::swap(a, b);
    borders_[a].erase(b);
    for (const auto& [other, border] : borders_[b]) {
      if (other == a) continue;
      borders_[a].append(other, border);
    }
    borders_[a].settle();
    for (const auto& [other, border] : borders_[b]) {
      if (other == a) continue;
      const Border& sum = borders_[a].at(other);
      borders_[other].erase(b);
      borders_[other].set(a, sum);
      propose(a, other, sum);
    }
    borders_[b].clear();
    parent_[b] = a;
    members_[a].insert(members_[a].end(), members_[b].begin(), members_[b].end());
    members_[b].clear();
    return a;
  }

  /// Whether a piece is covered by a thing: the base below an overhanging lid, whose seam is never seen. Or
  /// held from the side: it does not reach down as far, nor lies on top, and hardly meets anything else that
  /// it could rest on. A handle, that is: what is not held falls.
  [[nodiscard]] bool isPart(Index whole, Index piece) const {
    return isHeldBy(whole, piece) || isCoveredBy(whole, piece);
  }

  [[nodiscard]] bool isHeldBy(Index whole, Index piece) const {
    constexpr std::int32_t kOffGround = 1;  // cells
    constexpr int kLeastOfBorder = 3;       // times what it meets beside the whole
    int elsewhere = 0;
    for (const auto& [other, border] : borders_[piece]) elsewhere += other == whole ? 0 : border.pairs;
    if (borders_[piece].at(whole).pairs < kLeastOfBorder * elsewhere) return false;
    const auto [low, high] = heights(whole, 1.0);
    const auto [piece_low, piece_high] = heights(piece, kMostly);
    return piece_low >= low + kOffGround && 2 * piece_low < low + high && piece_high <= high;
  }

  /// Whether nearly all of a piece lies below a cell of the thing, or of one beside that.
  [[nodiscard]] bool isCoveredBy(Index whole, Index piece) const {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> top;
    for (const Index i : members_[whole]) {
      for (int step = 0; step < 9; ++step) {
        const auto [found, is_new] =
            top.try_emplace({cells_[i].x + step / 3 - 1, cells_[i].y + step % 3 - 1}, cells_[i].z);
        if (!is_new) found->second = std::max(found->second, cells_[i].z);
      }
    }
    const auto covered = std::count_if(members_[piece].begin(), members_[piece].end(), [&](Index i) {
      const auto found = top.find({cells_[i].x, cells_[i].y});
      return found != top.end() && found->second > cells_[i].z;
    });
    return static_cast<double>(covered) >= kMostly * static_cast<double>(members_[piece].size());
  }

  /// Lowest and highest cell; as many are left out at either end as are no part of `share`.
  [[nodiscard]] std::pair<std::int32_t, std::int32_t> heights(Index region, double share) const {
    std::vector<std::int32_t> z;
    for (const Index i : members_[region]) z.push_back(cells_[i].z);
    std::sort(z.begin(), z.end());
    const auto left_out = static_cast<std::size_t>((1.0 - share) * static_cast<double>(z.size()));
    return {z[left_out], z[z.size() - 1 - left_out]};
  }

  static constexpr double kMostly = 0.9;  // of a piece: cells along seams go either way
  std::vector<Cell> cells_;
  std::vector<Borders> borders_;
  std::vector<Index> parent_;
  std::vector<std::vector<Index>> members_;
  std::priority_queue<Candidate> queue_;
};

/// The cells of objects, and which of them have a border: those that some scan has shown together, and
/// neighbours.
class CellGraph {
 public:
  explicit CellGraph(const SeamVotes& votes) {
    index_.reserve(2 * votes.all().size());
    for (const auto& entry : votes.all()) {
      if (!entry.second.is_object) continue;
      index_[cellKey(entry.first)] = static_cast<Index>(entries_.size());
      entries_.push_back(&entry);
    }
  }

  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  [[nodiscard]] const Cell& cell(Index i) const { return entries_[i]->first; }
  [[nodiscard]] std::optional<Index> find(const Cell& cell) const {
    const auto found = index_.find(cellKey(cell));
    return found == index_.end() ? std::nullopt : std::optional(found->second);
  }

  /// Calls `visit(j, border)` for the cells that have a border with cell i, each border from one of its sides
  /// only.
  template <typename Visit>
  void forBorders(Index i, const Visit& visit) const {
    // Neighbours are one unless scans say otherwise: views drift apart by a cell.
    constexpr Border kNeighbours{-1, 1};
    const auto& [c, votes] = *entries_[i];
    for (std::size_t d = 0; d < SeamVotes::kDirections; ++d) {
      if (!votes.known[d]) continue;
      if (const auto j = find(SeamVotes::partner(c, d))) visit(*j, Border{votes.evidence[d], 1});
    }
    for (int step = 14; step < 27; ++step) {  // half of the 26 neighbours
      const auto j = find({c.x + step / 9 - 1, c.y + step / 3 % 3 - 1, c.z + step % 3 - 1});
      if (j) visit(*j, kNeighbours);
    }
  }

 private:
  std::vector<const std::pair<const Cell, SeamVotes::Votes>*> entries_;
  std::unordered_map<std::uint64_t, Index> index_;
};

struct CellBorder {
  Index a;
  Index b;
  Border border;
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
  const CellGraph graph(votes);
  std::vector<CellBorder> borders;
  for (Index i = 0; i < graph.size(); ++i) {
    graph.forBorders(i, [&](Index j, const Border& border) { borders.push_back({i, j, border}); });
  }
  std::vector<std::optional<Place>> places(graph.size());
  std::vector<Merging> mergings;
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
