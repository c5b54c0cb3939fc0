// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "PlaceEvidence.h"

namespace hoctomap {

/// A motion (in A's world) that takes a thing of A onto one of B.
struct Motion {
  Eigen::Isometry3d a_to_b = Eigen::Isometry3d::Identity();
  /// The smaller overlap of the two ways, mean of that at the usual distance and at half of it.
  double score = 0.0;
};

/// The two maps, and how each is held against the other.
struct TwoMaps {
  const MapSide& a;
  const MapSide& b;
  const PlaceEvidence& a_in_b;
  const PlaceEvidence& b_in_a;
};

/// Registers two things as one. Nothing if they are not clearly the same shape.
/// The same for (a, b) and (b, a), inverted: the more complete one is always taken as the model.
[[nodiscard]] std::optional<Motion> findMotion(const Thing& a, const Thing& b, const TwoMaps& maps,
                                               const DiffConfig& config);

/// The smaller overlap of the two ways, unknown counting against.
[[nodiscard]] double plainOverlap(const Thing& a, const Eigen::Isometry3d& a_to_b, const Thing& b,
                                  const TwoMaps& maps);

/// The smaller overlap of the two ways, of what can be compared.
[[nodiscard]] double visibleOverlap(const Thing& a, const Eigen::Isometry3d& a_to_b, const Thing& b,
                                    const TwoMaps& maps, Trust trust, double reach_factor = 1.0);

/// Whether a motion is larger than what poses err by.
[[nodiscard]] bool isLarge(const Eigen::Isometry3d& a_to_b, const Thing& a, const Thing& b,
                           const DiffConfig& config);

}  // namespace hoctomap
