// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MapSide.h"
#include "hoctomap/query/HierarchyDiff.h"

namespace hoctomap {

/// What another map says of the places of a thing's voxels, as shares of them.
struct Cover {
  double matched = 0.0;       ///< the other map has a surface of the same label there
  double contradicted = 0.0;  ///< it saw that there is none
  double seen = 0.0;          ///< it saw the place, whatever is there

  /// Share of what can be compared that is there; 0 if nothing can.
  [[nodiscard]] double overlap() const { return matched > 0.0 ? matched / (matched + contradicted) : 0.0; }
};

/// How the voxels of things are held against the other map.
class PlaceEvidence {
 public:
  PlaceEvidence(const MapSide& own, const MapSide& other, const DiffConfig& config)
      : own_(own), other_(other), config_(config) {}

  /// Of all surfaces of its label together: two things that one map has as one node are no change.
  [[nodiscard]] Cover cover(const Thing& thing) const;

  /// Of a single other thing, after a motion (in A's world). Place of the voxels: where they have moved to.
  /// `reach_factor`: surfaces nearer than that part of the usual distance are one.
  [[nodiscard]] Cover cover(const Thing& thing, const Eigen::Isometry3d& motion, const Thing& on,
                            Trust trust = Trust::sure, double reach_factor = 1.0) const;

  /// Share of a thing's place that the other map knows: it saw it, or has one of these boxes there.
  [[nodiscard]] double seenShare(const Thing& thing, const std::vector<Obb>& filled) const;

  /// What the other map says of a place that the thing may have come to (world).
  [[nodiscard]] Sight sight(const Thing& thing, const Eigen::Vector3d& p) const;

  /// Height of what a thing of the own map stands on, where it stands, m.
  [[nodiscard]] std::optional<double> supportHeight(const Thing& thing) const;

  /// Whether the other map would have to have the thing sunk into what it stands on.
  [[nodiscard]] bool sinks(const Thing& thing, const Eigen::Isometry3d& motion, const Thing& on) const;

  /// Share of the thing's voxels that lie near those of another one, after a motion; unknown counts against.
  [[nodiscard]] double plainOverlap(const Thing& thing, const Eigen::Isometry3d& motion,
                                    const Thing& on) const;

 private:
  enum class Support { unknown, seen, seen_by_both };
  [[nodiscard]] double reach(const Thing& thing, const Thing& on) const;
  [[nodiscard]] const Thing* supportOf(const MapSide& side, const Thing& thing) const;
  [[nodiscard]] const Thing* supportAt(const Thing& thing, const Eigen::Vector3d& p) const;
  [[nodiscard]] Support support(const Thing& thing, const Eigen::Vector3d& from,
                                const Eigen::Vector3d& to) const;
  [[nodiscard]] bool mayLieInShadow(const Eigen::Vector3d& p) const;
  [[nodiscard]] Place placeAt(const Eigen::Vector3d& p, Trust trust) const;
  template <typename IsMatched>
  [[nodiscard]] Cover count(const Thing& thing, const Eigen::Isometry3d& motion, Trust trust,
                            const IsMatched& is_matched) const;

  const MapSide& own_;
  const MapSide& other_;
  const DiffConfig& config_;
};

}  // namespace hoctomap
