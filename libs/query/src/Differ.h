// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "MotionSearch.h"

namespace hoctomap {

/// One comparison of two maps: what is known so far of each thing, and the steps that find out more.
class Differ {
 public:
  Differ(const MapHierarchy& a, const MapHierarchy& b, const DiffConfig& config,
         const Eigen::Isometry3d& a_T_b);

  void compareInPlace();      ///< what is where it was
  void findShifted();         ///< moved, with old and new place overlapping
  void findMovedElsewhere();  ///< what is in one map only, against what is in the other only
  void carryChildren();       ///< tables that moved, and what stood on them
  void findReshaped();        ///< changed
  void reportRest();          ///< added, removed, unobservable

  [[nodiscard]] std::vector<Change> changes() const;

 private:
  enum class Fate { open, present, doubtful, paired, reported };
  struct Known {
    Cover cover;
    Fate fate = Fate::open;
    bool may_be_new = false;
    std::string detail;
  };
  struct Candidate {
    std::size_t a = 0;
    std::size_t b = 0;
    Motion motion;
  };
  struct Carrier;

  [[nodiscard]] Known inPlace(const Thing& thing, const PlaceEvidence& evidence, const MapSide& other,
                              const PlaceEvidence& reverse) const;
  [[nodiscard]] bool touches(const Thing& a, const Thing& b) const;
  [[nodiscard]] bool isContradicted(std::size_t a, std::size_t b) const;
  void considerShift(std::size_t a, std::size_t b, std::vector<Candidate>& shifted);
  void findSuspects(const MapSide& side, std::vector<Known>& known, const PlaceEvidence& evidence,
                    const MapSide& other, const std::vector<Known>& known_other) const;
  void settle(std::vector<Candidate> candidates, bool ask_for_rivals);
  [[nodiscard]] static bool isMissing(const Known& known);
  [[nodiscard]] static bool isPresent(const Known& known);
  [[nodiscard]] static bool mayBeReshaped(const Known& a, const Known& b);
  void pair(const Candidate& candidate);

  [[nodiscard]] std::optional<Carrier> movedCarrier(std::size_t a) const;
  void carry(const Carrier& carrier);

  Change& report(ChangeKind kind, const Thing* a, const Thing* b, double score);
  void reportMissing(const MapSide& side, std::vector<Known>& known, bool in_a);

  const DiffConfig& config_;
  MapSide a_;
  MapSide b_;
  PlaceEvidence a_in_b_;
  PlaceEvidence b_in_a_;
  TwoMaps maps_;
  std::vector<Known> known_a_;
  std::vector<Known> known_b_;
  std::vector<Candidate> moved_;
  std::vector<Change> changes_;
};

}  // namespace hoctomap
