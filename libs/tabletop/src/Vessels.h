// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "ObjectCandidates.h"

namespace hoctomap {

using Cluster = std::vector<Candidate>;

/// What the decisions about a cluster rest on.
struct ClusterShape {
  Eigen::AlignedBox3d box;        ///< world
  double lowest = 0.0;            ///< m above the table
  double highest = 0.0;           ///< m above the table
  double top_share = 0.0;         ///< share of the points within 1 cm of the highest, and above
  double range = 0.0;             ///< m from the sensor, mean
  double half_width = 0.0;        ///< m, of its narrower side, seen from above
  std::size_t outside = 0;        ///< points beyond the table or above the height limit
  std::size_t under = 0;          ///< points below the table
  std::size_t thin = 0;           ///< points of thin things
  std::vector<std::size_t> foot;  ///< cells under its lowest points
};

struct ShapedCluster {
  Cluster points;
  ClusterShape shape;
};

/// Joins the inside of a cup or bowl to its outside: where the sensor loses the thin rim, the far inner wall
/// is a cluster of its own. It ends at the height of the other's rim, lies behind it, is a wall and not the
/// top of a box, and makes a round thing with it.
void joinVessels(std::vector<ShapedCluster>& objects, const Measurement& z,
                 const TabletopSegmentationConfig& config);

}  // namespace hoctomap
