// SPDX-License-Identifier: BSD-3-Clause
#include "Differ.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>

namespace hoctomap {

namespace {

const Eigen::Isometry3d kStill = Eigen::Isometry3d::Identity();
constexpr double kLeastMatched = 0.25;      // share of a thing that must be there to call it there
constexpr double kLeastContradicted = 0.1;  // share that must speak against a place before a motion is tried
constexpr double kLeastGain = 0.1;          // of overlap, for which a motion is believed

}  // namespace

Differ::Differ(const MapHierarchy& a, const MapHierarchy& b, const DiffConfig& config,
               const Eigen::Isometry3d& a_T_b)
    : config_(config),
      a_(a, kStill, config.fine_resolution),
      b_(b, a_T_b, config.fine_resolution),
      a_in_b_(a_, b_, config),
      b_in_a_(b_, a_, config),
      maps_{a_, b_, a_in_b_, b_in_a_} {}

void Differ::compareInPlace() {
  for (const Thing& thing : a_.things()) known_a_.push_back(inPlace(thing, a_in_b_, b_, b_in_a_));
  for (const Thing& thing : b_.things()) known_b_.push_back(inPlace(thing, b_in_a_, a_, a_in_b_));
}

Differ::Known Differ::inPlace(const Thing& thing, const PlaceEvidence& evidence, const MapSide& other,
                              const PlaceEvidence& reverse) const {
  Known known;
  known.cover = evidence.cover(thing);
  const double overlap = known.cover.overlap();
  if (overlap < config_.same_overlap) return known;
  // Much of it must be there; or, where the other map has seen little of it, that little must be all it has.
  const bool enough = known.cover.matched >= kLeastMatched ||
                      std::any_of(other.things().begin(), other.things().end(), [&](const Thing& part) {
                        return part.label == thing.label && touches(thing, part) &&
                               reverse.plainOverlap(part, kStill, thing) >= config_.same_overlap;
                      });
  if (enough) known.fate = overlap >= config_.clear_overlap ? Fate::present : Fate::doubtful;
  return known;
}

bool Differ::touches(const Thing& a, const Thing& b) const {
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(config_.near + a.resolution + b.resolution);
  return Eigen::AlignedBox3d(a.bounds.min() - margin, a.bounds.max() + margin).intersects(b.bounds);
}

void Differ::findShifted() {
  std::vector<Candidate> shifted;
  for (std::size_t a = 0; a < known_a_.size(); ++a) {
    for (std::size_t b = 0; b < known_b_.size(); ++b) {
      if (a_.things()[a].label == b_.things()[b].label && touches(a_.things()[a], b_.things()[b])) {
        considerShift(a, b, shifted);
      }
    }
  }
  settle(std::move(shifted), false);
}

bool Differ::isContradicted(std::size_t a, std::size_t b) const {
  return std::max(known_a_[a].cover.contradicted, known_b_[b].cover.contradicted) >= kLeastContradicted;
}

void Differ::considerShift(std::size_t a, std::size_t b, std::vector<Candidate>& shifted) {
  const Thing& in_a = a_.things()[a];
  const Thing& in_b = b_.things()[b];
  const double before = plainOverlap(in_a, kStill, in_b, maps_);
  // Two views of different sides overlap little, too: without a contradiction it has not moved.
  if (before >= config_.clear_overlap || !isContradicted(a, b)) return;
  const auto motion = findMotion(in_a, in_b, maps_, config_);
  if (!motion || plainOverlap(in_a, motion->a_to_b, in_b, maps_) < before + kLeastGain) return;
  if (isLarge(motion->a_to_b, in_a, in_b, config_)) {
    shifted.push_back({a, b, *motion});
  } else {  // an error of the poses
    known_a_[a].fate = known_b_[b].fate = Fate::present;
  }
}

bool Differ::isMissing(const Known& known) {
  return known.fate == Fate::open;
}

bool Differ::isPresent(const Known& known) {
  return known.fate == Fate::present || known.fate == Fate::doubtful;
}

/// What may have come to its place, or gone from it: what the other map does not have, or has only in so far
/// as it has something else there that is no longer there. Inside of such things nothing was seen, and yet it
/// is known.
void Differ::findSuspects(const MapSide& side, std::vector<Known>& known, const PlaceEvidence& evidence,
                          const MapSide& other, const std::vector<Known>& known_other) const {
  std::vector<Obb> filled;
  for (std::size_t i = 0; i < known_other.size(); ++i) {
    if (!isPresent(known_other[i])) filled.push_back(other.things()[i].box);
  }
  for (std::size_t i = 0; i < known.size(); ++i) {
    const Thing& thing = side.things()[i];
    const auto isSameThing = [&](std::size_t k) {
      const Thing& there = other.things()[k];
      return !isMissing(known_other[k]) && there.label == thing.label && touches(thing, there) &&
             evidence.plainOverlap(thing, kStill, there) >= kLeastMatched;
    };
    known[i].may_be_new = isMissing(known[i]);
    if (isPresent(known[i])) {
      // A ball where a box stood lies close to the box's sides, and yet it has come.
      known[i].may_be_new = true;
      for (std::size_t k = 0; k < known_other.size(); ++k) {
        if (isSameThing(k)) known[i].may_be_new = false;
      }
    }
    if (known[i].may_be_new) known[i].cover.seen = evidence.seenShare(thing, filled);
  }
}

void Differ::findMovedElsewhere() {
  findSuspects(a_, known_a_, a_in_b_, b_, known_b_);
  findSuspects(b_, known_b_, b_in_a_, a_, known_a_);
  std::vector<Candidate> candidates;
  for (std::size_t a = 0; a < known_a_.size(); ++a) {
    for (std::size_t b = 0; b < known_b_.size(); ++b) {
      const Thing& in_a = a_.things()[a];
      const Thing& in_b = b_.things()[b];
      if (in_a.label != in_b.label || !known_a_[a].may_be_new || !known_b_[b].may_be_new) continue;
      if (!isMissing(known_a_[a]) && !isMissing(known_b_[b])) continue;
      // Not seen at the old place is not gone from it; not seen at the new one is not new there.
      if (std::min(known_a_[a].cover.seen, known_b_[b].cover.seen) < config_.seen_for_motion) continue;
      const auto motion = findMotion(in_a, in_b, maps_, config_);
      if (motion && isLarge(motion->a_to_b, in_a, in_b, config_)) candidates.push_back({a, b, *motion});
    }
  }
  settle(std::move(candidates), true);
}

/// Takes the best fits first. Look-alikes cannot be told apart: nothing is guessed about them.
void Differ::settle(std::vector<Candidate> candidates, bool ask_for_rivals) {
  const auto order = [this](const Candidate& c) {
    const auto ids = std::minmax(a_.things()[c.a].id, b_.things()[c.b].id);
    return std::tuple(-c.motion.score, ids.first, ids.second);
  };
  std::sort(candidates.begin(), candidates.end(),
            [&](const Candidate& x, const Candidate& y) { return order(x) < order(y); });
  const auto taken = [this](const Candidate& c) {
    return known_a_[c.a].fate == Fate::paired || known_b_[c.b].fate == Fate::paired;
  };
  for (const Candidate& best : candidates) {
    if (taken(best)) continue;
    const auto rival = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& c) {
      return (c.a == best.a) != (c.b == best.b) && !taken(c) &&
             c.motion.score >= best.motion.score - config_.rival_score;
    });
    if (!ask_for_rivals || rival == candidates.end()) {
      pair(best);
      continue;
    }
    const std::string a_name = std::to_string(a_.things()[best.a].id.value);
    const std::string b_name = std::to_string(b_.things()[best.b].id.value);
    known_a_[best.a].detail = "may have moved: looks like node " + b_name + " of B, but is not the only one";
    known_b_[best.b].detail = "may have moved: looks like node " + a_name + " of A, but is not the only one";
  }
}

void Differ::pair(const Candidate& candidate) {
  known_a_[candidate.a].fate = known_b_[candidate.b].fate = Fate::paired;
  moved_.push_back(candidate);
}

/// At least one of them has something that the other map does not, and neither is told of already.
bool Differ::mayBeReshaped(const Known& a, const Known& b) {
  const auto isFree = [](const Known& known) { return isMissing(known) || isPresent(known); };
  return isFree(a) && isFree(b) && (isMissing(a) || isMissing(b));
}

void Differ::findReshaped() {
  for (std::size_t a = 0; a < known_a_.size(); ++a) {
    const Thing& in_a = a_.things()[a];
    std::optional<std::size_t> best;
    double best_overlap = config_.least_overlap;
    for (std::size_t b = 0; b < known_b_.size(); ++b) {
      const Thing& in_b = b_.things()[b];
      if (in_a.label != in_b.label || !touches(in_a, in_b) || !mayBeReshaped(known_a_[a], known_b_[b]))
        continue;
      const double overlap = visibleOverlap(in_a, kStill, in_b, maps_, Trust::sure);
      if (overlap < best_overlap || plainOverlap(in_a, kStill, in_b, maps_) < kLeastMatched) continue;
      best = b;
      best_overlap = overlap;
    }
    if (!best) continue;
    known_a_[a].fate = known_b_[*best].fate = Fate::reported;
    report(ChangeKind::changed, &in_a, &b_.things()[*best], best_overlap);
  }
}

void Differ::reportRest() {
  reportMissing(a_, known_a_, true);
  reportMissing(b_, known_b_, false);
}

void Differ::reportMissing(const MapSide& side, std::vector<Known>& known, bool in_a) {
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (!isMissing(known[i])) continue;
    const Thing& thing = side.things()[i];
    const double seen = known[i].cover.seen;
    const ChangeKind gone = in_a ? ChangeKind::removed : ChangeKind::added;
    report(seen >= config_.seen_share ? gone : ChangeKind::unobservable, in_a ? &thing : nullptr,
           in_a ? nullptr : &thing, seen)
        .detail = known[i].detail;
  }
}

Change& Differ::report(ChangeKind kind, const Thing* a, const Thing* b, double score) {
  const Thing* first = a != nullptr ? a : b;
  if (first == nullptr) throw std::logic_error("a change is about a thing of one of the maps");
  Change& change = changes_.emplace_back();
  change.kind = kind;
  if (a != nullptr) change.node_a = a->id;
  if (b != nullptr) change.node_b = b->id;
  change.label = first->label;
  change.position = first->position;
  change.score = score;
  return change;
}

std::vector<Change> Differ::changes() const {
  std::vector<Change> sorted = changes_;
  const auto order = [](const Change& c) { return std::tie(c.kind, c.node_a, c.node_b); };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Change& x, const Change& y) { return order(x) < order(y); });
  return sorted;
}

}  // namespace hoctomap
