// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

namespace hoctomap {

/// Sensor model of a node map: OctoMap's parameters, as probabilities. The defaults are OctoMap's.
struct OccupancyModel {
  double prob_hit = 0.7;
  double prob_miss = 0.4;
  double clamping_min = 0.1192;
  double clamping_max = 0.971;
  double occupancy_threshold = 0.5;

  /// Sets these parameters in a tree.
  void applyTo(octomap::OcTree& tree) const;
};

}  // namespace hoctomap
