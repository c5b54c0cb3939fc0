// SPDX-License-Identifier: BSD-3-Clause
#include "RegionMerging.h"

#include <map>
#include <optional>

#include "SurfaceRegions.h"

namespace hoctomap {

RegionMerging::RegionMerging(std::vector<SeamVotes::Cell> cells)
    : cells_(std::move(cells)), borders_(cells_.size()) {
  for (CellIndex i = 0; i < cells_.size(); ++i) {
    parent_.push_back(i);
    members_.push_back({i});
  }
}

void RegionMerging::addBorder(CellIndex a, CellIndex b, const SeamBorder& border) {
  borders_[a].append(b, border);
  borders_[b].append(a, border);
}

void RegionMerging::mergeWhatIsOne() {
  for (auto& borders : borders_) borders.settle();
  std::vector<Candidate> candidates;
  for (CellIndex a = 0; a < borders_.size(); ++a) {
    for (const auto& [b, border] : borders_[a]) {
      if (a < b && border.evidence < 0) candidates.push_back({border.certainty(), a, b});
    }
  }
  queue_ = std::priority_queue<Candidate>({}, std::move(candidates));
  while (!queue_.empty()) {
    const Candidate top = queue_.top();
    queue_.pop();
    const SeamBorder* const border = borders_[top.a].find(top.b);
    if (border == nullptr || border->certainty() != top.certainty) continue;  // outdated
    merge(top.a, top.b);
  }
}

void RegionMerging::absorbFragments() {
  for (bool again = true; again;) {
    again = false;
    for (CellIndex r = 0; r < parent_.size(); ++r) {
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

void RegionMerging::joinParts() {
  constexpr double kMostShare = 0.3;
  std::vector<CellIndex> order;
  for (CellIndex r = 0; r < parent_.size(); ++r) {
    if (isRegion(r)) order.push_back(r);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](CellIndex a, CellIndex b) { return members_[a].size() > members_[b].size(); });
  for (const CellIndex whole : order) {
    if (!isRegion(whole)) continue;
    std::vector<CellIndex> pieces;
    for (const auto& [other, border] : borders_[whole]) {
      const double share =
          static_cast<double>(members_[other].size()) / static_cast<double>(members_[whole].size());
      if (share <= kMostShare && isPart(whole, other)) pieces.push_back(other);
    }
    std::sort(pieces.begin(), pieces.end());
    CellIndex kept = whole;
    for (const CellIndex piece : pieces) kept = merge(kept, piece);
  }
}

void RegionMerging::joinCarriers() {
  for (CellIndex load = 0; load < parent_.size(); ++load) {
    for (bool again = isRegion(load); again;) {
      again = false;
      std::vector<CellIndex> around;
      for (const auto& [other, border] : borders_[load]) around.push_back(other);
      for (std::size_t i = 0; i < around.size() && !again; ++i) {
        for (std::size_t j = i + 1; j < around.size() && !again; ++j) {
          again = carry(around[i], around[j], load);
          if (again) merge(around[i], around[j]);
        }
      }
    }
  }
}

bool RegionMerging::carry(CellIndex a, CellIndex b, CellIndex load) const {
  constexpr std::int32_t kSame = 1;  // cells
  constexpr int kConvexCut = 2;  // a pair; what a cut at a convex edge says, seen once: an edge of its own
  const SeamBorder* border = borders_[a].find(b);
  if (border != nullptr && border->evidence > kConvexCut * border->pairs) return false;
  const auto [low_a, high_a] = heights(a, kMostly);
  const auto [low_b, high_b] = heights(b, kMostly);
  const auto [foot, top] = heights(load, kMostly);
  return high_a == high_b && std::abs(low_a - low_b) <= kSame && foot + kSame >= high_a;
}

CellIndex RegionMerging::regionOf(CellIndex cell) {
  while (parent_[cell] != cell) cell = parent_[cell] = parent_[parent_[cell]];
  return cell;
}

void RegionMerging::propose(CellIndex a, CellIndex b, const SeamBorder& border) {
  if (border.evidence < 0) queue_.push({border.certainty(), std::min(a, b), std::max(a, b)});
}

CellIndex RegionMerging::merge(CellIndex a, CellIndex b) {
  if (borders_[a].size() < borders_[b].size()) std::swap(a, b);
  borders_[a].erase(b);
  borders_[a].take(borders_[b], a);
  for (const auto& [other, border] : borders_[b]) {
    if (other == a) continue;
    const SeamBorder& sum = borders_[a].at(other);
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

bool RegionMerging::isPart(CellIndex whole, CellIndex piece) const {
  return isHeldBy(whole, piece) || isCoveredBy(whole, piece);
}

bool RegionMerging::isHeldBy(CellIndex whole, CellIndex piece) const {
  constexpr std::int32_t kOffGround = 1;  // cells
  constexpr int kLeastOfBorder = 3;       // times what it meets beside the whole
  int elsewhere = 0;
  for (const auto& [other, border] : borders_[piece]) elsewhere += other == whole ? 0 : border.pairs;
  if (borders_[piece].at(whole).pairs < kLeastOfBorder * elsewhere) return false;
  const auto [low, high] = heights(whole, 1.0);
  const auto [piece_low, piece_high] = heights(piece, kMostly);
  return piece_low >= low + kOffGround && 2 * piece_low < low + high && piece_high <= high;
}

bool RegionMerging::isCoveredBy(CellIndex whole, CellIndex piece) const {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> top;
  for (const CellIndex i : members_[whole]) {
    for (int step = 0; step < 9; ++step) {
      const auto [found, is_new] =
          top.try_emplace({cells_[i].x + step / 3 - 1, cells_[i].y + step % 3 - 1}, cells_[i].z);
      if (!is_new) found->second = std::max(found->second, cells_[i].z);
    }
  }
  const auto covered = std::count_if(members_[piece].begin(), members_[piece].end(), [&](CellIndex i) {
    const auto found = top.find({cells_[i].x, cells_[i].y});
    return found != top.end() && found->second > cells_[i].z;
  });
  return static_cast<double>(covered) >= kMostly * static_cast<double>(members_[piece].size());
}

std::pair<std::int32_t, std::int32_t> RegionMerging::heights(CellIndex region, double share) const {
  std::vector<std::int32_t> z;
  for (const CellIndex i : members_[region]) z.push_back(cells_[i].z);
  std::sort(z.begin(), z.end());
  const auto left_out = static_cast<std::size_t>((1.0 - share) * static_cast<double>(z.size()));
  return {z[left_out], z[z.size() - 1 - left_out]};
}

}  // namespace hoctomap
