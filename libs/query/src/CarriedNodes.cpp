// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "Differ.h"

namespace hoctomap {

namespace {

constexpr double kSameMotion = 0.02;  // m, at the thing itself: it moved as its table did
constexpr double kLeastGain = 0.05;   // of a table's overlap; its own plane hardly tells its motion

}  // namespace

/// Something that moved with what stands on it.
struct Differ::Carrier {
  Candidate self;
  std::vector<std::pair<std::size_t, std::size_t>> children;  ///< in A, in B
};

/// A plane slides over itself: what tells a table's motion is that of the things on it, if it explains the
/// table's outline better than that the table stands still.
std::optional<Differ::Carrier> Differ::movedCarrier(std::size_t a) const {
  const Thing& table = a_.things()[a];
  const auto isChild = [&](const Thing& thing) { return thing.parent == table.id; };
  std::size_t still = 0;
  for (std::size_t i = 0; i < known_a_.size(); ++i) {
    if (isChild(a_.things()[i]) && isPresent(known_a_[i])) ++still;
  }
  std::optional<Carrier> best;
  for (const Candidate& child : moved_) {
    const Thing& in_b = b_.things()[child.b];
    if (!isChild(a_.things()[child.a]) || !in_b.parent) continue;
    const auto b = b_.find(*in_b.parent);
    if (!b || b_.things()[*b].label != table.label) continue;
    Carrier carrier{{a, *b, child.motion}, {}};
    for (const Candidate& other : moved_) {
      const Thing& thing = a_.things()[other.a];
      const Eigen::Vector3d where = other.motion.a_to_b * thing.position;
      if (isChild(thing) && b_.things()[other.b].parent == in_b.parent &&
          (child.motion.a_to_b * thing.position - where).norm() <= kSameMotion) {
        carrier.children.emplace_back(other.a, other.b);
      }
    }
    if (carrier.children.size() <= still) continue;
    carrier.self.motion.score =
        visibleOverlap(table, child.motion.a_to_b, b_.things()[*b], maps_, Trust::any);
    const auto rank = [](const Carrier& c) { return std::pair(c.children.size(), c.self.motion.score); };
    if (!best || rank(carrier) > rank(*best)) best = carrier;
  }
  if (!best) return std::nullopt;
  const double in_place =
      visibleOverlap(table, Eigen::Isometry3d::Identity(), b_.things()[best->self.b], maps_, Trust::any);
  if (best->self.motion.score < std::max(config_.same_overlap, in_place + kLeastGain)) return std::nullopt;
  return best;
}

void Differ::carryChildren() {
  for (std::size_t a = 0; a < known_a_.size(); ++a) {
    if (const auto carrier = movedCarrier(a)) carry(*carrier);
  }
  for (const Candidate& m : moved_) {
    const bool carried = known_a_[m.a].fate == Fate::reported;
    if (carried) continue;
    report(ChangeKind::moved, &a_.things()[m.a], &b_.things()[m.b], m.motion.score).motion = m.motion.a_to_b;
  }
}

void Differ::carry(const Carrier& carrier) {
  const std::size_t a = carrier.self.a;
  const std::size_t b = carrier.self.b;
  // Whatever the table's own plane was taken for before.
  std::erase_if(moved_, [&](const Candidate& m) {
    if (m.a != a && m.b != b) return false;
    known_a_[m.a].fate = known_b_[m.b].fate = Fate::open;
    return true;
  });
  known_a_[a].fate = known_b_[b].fate = Fate::reported;
  Change& change = report(ChangeKind::moved, &a_.things()[a], &b_.things()[b], carrier.self.motion.score);
  change.motion = carrier.self.motion.a_to_b;
  auto children = carrier.children;
  // What looked too much alike, or was hidden in part, is told by where the table has gone.
  for (std::size_t i = 0; i < known_a_.size(); ++i) {
    const Thing& thing = a_.things()[i];
    if (thing.parent != a_.things()[a].id || !isMissing(known_a_[i])) continue;
    for (std::size_t k = 0; k < known_b_.size(); ++k) {
      const Thing& there = b_.things()[k];
      if (!isMissing(known_b_[k]) || there.label != thing.label || there.parent != b_.things()[b].id)
        continue;
      if (visibleOverlap(thing, change.motion, there, maps_, Trust::sure) < config_.same_overlap) continue;
      children.emplace_back(i, k);
      known_a_[i].fate = known_b_[k].fate = Fate::paired;
      break;
    }
  }
  std::sort(children.begin(), children.end());
  for (const auto& [child_a, child_b] : children) {
    known_a_[child_a].fate = known_b_[child_b].fate = Fate::reported;
    change.carried.emplace_back(a_.things()[child_a].id, b_.things()[child_b].id);
  }
}

}  // namespace hoctomap
