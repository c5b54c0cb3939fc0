// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <queue>
#include <utility>
#include <vector>

#include "hoctomap/mapping/SeamVotes.h"

namespace hoctomap {

/// Number of a cell among those that are merged, and of the region that it stands for.
using CellIndex = std::uint32_t;

/// What speaks for and against a seam along a border.
struct SeamBorder {
  int evidence = 0;  ///< positive: for two things
  int pairs = 0;

  void add(const SeamBorder& other) {
    evidence += other.evidence;
    pairs += other.pairs;
  }
  /// A sum of `pairs` votes is sure by its ratio to their square root: neither long borders nor short ones
  /// are preferred.
  [[nodiscard]] double certainty() const { return -evidence / std::sqrt(static_cast<double>(pairs)); }
};

/// The borders of one region, in the order of the others: short lists that are walked far more often than
/// changed.
class RegionBorders {
 public:
  struct Entry {
    CellIndex other;
    SeamBorder border;
  };

  /// In any order, also several of one other; before anything else `settle` puts them into theirs.
  void append(CellIndex other, const SeamBorder& border) { entries_.push_back({other, border}); }
  void settle() {
    std::sort(entries_.begin(), entries_.end(), isBefore);
    addUpEqual();
  }
  /// Those of another region, too; but for the one to `except`.
  void take(const RegionBorders& borders, CellIndex except) {
    const auto own = static_cast<std::ptrdiff_t>(entries_.size());
    std::copy_if(borders.entries_.begin(), borders.entries_.end(), std::back_inserter(entries_),
                 [&](const Entry& entry) { return entry.other != except; });
    std::inplace_merge(entries_.begin(), entries_.begin() + own, entries_.end(), isBefore);
    addUpEqual();
  }

  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  [[nodiscard]] auto begin() const { return entries_.begin(); }
  [[nodiscard]] auto end() const { return entries_.end(); }
  [[nodiscard]] const SeamBorder* find(CellIndex other) const {
    const auto at = std::lower_bound(entries_.begin(), entries_.end(), Entry{other, {}}, isBefore);
    return at != entries_.end() && at->other == other ? &at->border : nullptr;
  }
  /// There is one.
  [[nodiscard]] const SeamBorder& at(CellIndex other) const {
    return std::lower_bound(entries_.begin(), entries_.end(), Entry{other, {}}, isBefore)->border;
  }
  void set(CellIndex other, const SeamBorder& border) {
    const auto at = std::lower_bound(entries_.begin(), entries_.end(), Entry{other, {}}, isBefore);
    if (at != entries_.end() && at->other == other)
      at->border = border;
    else
      entries_.insert(at, {other, border});
  }
  void erase(CellIndex other) {
    const auto at = std::lower_bound(entries_.begin(), entries_.end(), Entry{other, {}}, isBefore);
    if (at != entries_.end() && at->other == other) entries_.erase(at);
  }
  void clear() { entries_.clear(); }

 private:
  static bool isBefore(const Entry& a, const Entry& b) { return a.other < b.other; }
  void addUpEqual() {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      if (kept > 0 && entries_[kept - 1].other == entries_[i].other)
        entries_[kept - 1].border.add(entries_[i].border);
      else
        entries_[kept++] = entries_[i];
    }
    entries_.resize(kept);
  }
  std::vector<Entry> entries_;
};

/// Joins cells to regions: the two whose border most speaks for one thing, until no border speaks for it
/// (docs/decisions/0028).
class RegionMerging {
 public:
  explicit RegionMerging(std::vector<SeamVotes::Cell> cells);

  /// All of them, before the rest; several of the same two add up.
  void addBorder(CellIndex a, CellIndex b, const SeamBorder& border);

  void mergeWhatIsOne();
  /// Small pieces belong to what they are least parted from.
  void absorbFragments();
  /// A small piece that a larger thing covers or holds is a part of it.
  void joinParts();
  /// The sides of a thing that carries another one are never seen together: its top is hidden. Of as high
  /// pieces between which no seam is seen, all that carry the same thing are one.
  void joinCarriers();

  [[nodiscard]] CellIndex regionOf(CellIndex cell);
  [[nodiscard]] const RegionBorders& bordersOf(CellIndex region) const { return borders_[region]; }

 private:
  struct Candidate {
    double certainty;
    CellIndex a;  ///< a < b
    CellIndex b;
    bool operator<(const Candidate& other) const {
      return certainty != other.certainty ? certainty < other.certainty
                                          : (a != other.a ? a > other.a : b > other.b);
    }
  };

  [[nodiscard]] bool isRegion(CellIndex r) const { return parent_[r] == r; }
  void propose(CellIndex a, CellIndex b, const SeamBorder& border);
  /// The one with fewer borders goes into the other, which is returned.
  CellIndex merge(CellIndex a, CellIndex b);

  [[nodiscard]] bool carry(CellIndex a, CellIndex b, CellIndex load) const;

  /// Whether a piece is covered by a thing: the base below an overhanging lid, whose seam is never seen. Or
  /// held from the side: it does not reach down as far, nor lies on top, and hardly meets anything else that
  /// it could rest on. A handle, that is: what is not held falls.
  [[nodiscard]] bool isPart(CellIndex whole, CellIndex piece) const;
  [[nodiscard]] bool isHeldBy(CellIndex whole, CellIndex piece) const;
  /// Whether nearly all of a piece lies below a cell of the thing, or of one beside that.
  [[nodiscard]] bool isCoveredBy(CellIndex whole, CellIndex piece) const;
  /// Lowest and highest cell; as many are left out at either end as are no part of `share`.
  [[nodiscard]] std::pair<std::int32_t, std::int32_t> heights(CellIndex region, double share) const;

  static constexpr double kMostly = 0.9;  // of a piece: cells along seams go either way
  std::vector<SeamVotes::Cell> cells_;
  std::vector<RegionBorders> borders_;
  std::vector<CellIndex> parent_;
  std::vector<std::vector<CellIndex>> members_;
  std::priority_queue<Candidate> queue_;
};

}  // namespace hoctomap
