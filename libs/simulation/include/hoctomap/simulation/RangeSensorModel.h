// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "hoctomap/geometry/Measurement.h"

namespace hoctomap {

/// A depth camera with the faults of a structured-light sensor. Depths z are along the optical axis, metres.
/// The defaults resemble a Kinect.
struct RangeSensorModel {
  PinholeCamera camera{640, 480, 540.0, 540.0, 319.5, 239.5};
  double min_range = 0.4;  ///< nearer: no return
  double max_range = 6.0;  ///< farther: no return

  /// Standard deviation of a depth: noise_constant + noise_quadratic z^2.
  double noise_constant = 0.0003;   ///< m
  double noise_quadratic = 0.0012;  ///< 1/m

  /// A disparity fx * baseline / z is rounded to multiples of `disparity_step`. 0 = off.
  double disparity_baseline = 0.075;  ///< m
  double disparity_step = 0.0;        ///< pixels
  /// Depths are rounded to multiples of this, as logs store them. 0 = off.
  double depth_unit = 0.001;  ///< m

  double dropout = 0.0;  ///< probability that any pixel has no return
  /// Angle between beam and normal at which returns begin to fail, and at which none is left (linear
  /// between).
  double grazing_begin = 80.0;  ///< degrees
  double grazing_end = 89.0;    ///< degrees

  /// A pixel lies at an edge if a neighbour's depth differs by more than this fraction of the smaller depth.
  double edge_jump = 0.03;
  double edge_dropout = 0.6;  ///< probability of no return at an edge
  double edge_mixed = 0.0;    ///< probability of a depth between the two sides of the edge
};

/// Noise-free, fault-free RangeSensorModel with the same camera and range limits.
[[nodiscard]] RangeSensorModel ideal(RangeSensorModel model);

/// @throws ConfigError if the camera has no pixels or focal length, limits are out of order, or probabilities
///         outside [0, 1].
void check(const RangeSensorModel& model);

}  // namespace hoctomap
