// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "hoctomap/existence/BeamExistenceModel.h"
#include "hoctomap/mapping/Registration.h"

namespace hoctomap {

/// When a segment counts as a known object that has moved (III-D).
struct ReidentificationConfig {
  bool enabled = true;
  double most_present = 0.85;  ///< share of a node's beams that end on it, above which it has not moved
  /// m, mean over the surface, beside what the scan shifts all: smaller motions are errors of the poses.
  double least_shift = 0.005;
  double least_gain = 0.1;  ///< of the score over staying at rest, if the segment lies in the node's box
  /// Score of a motion within the node's box, unless the scan contradicts the node: views of it just differ.
  double least_in_place = 0.95;
  double rival_score = 0.05;  ///< two fits whose scores differ by less are ambiguous
  RangeNoise noise;           ///< of the sensor
  RegistrationConfig registration;
};

}  // namespace hoctomap
