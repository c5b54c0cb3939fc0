// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/octree/OccupancyModel.h"

namespace hoctomap {

void OccupancyModel::applyTo(octomap::OcTree& tree) const {
  tree.setProbHit(prob_hit);
  tree.setProbMiss(prob_miss);
  tree.setClampingThresMin(clamping_min);
  tree.setClampingThresMax(clamping_max);
  tree.setOccupancyThres(occupancy_threshold);
}

}  // namespace hoctomap
