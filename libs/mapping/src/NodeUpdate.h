// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "hoctomap/geometry/Measurement.h"
#include "hoctomap/hierarchy/MapNode.h"
#include "hoctomap/mapping/LabelProfile.h"

namespace hoctomap {

/// What the update of one node's map needs of a scan.
struct NodeUpdate {
  MapNode* node = nullptr;
  Pose world_T_node;
  const LabelProfile* profile = nullptr;
  PointIndices points;      ///< endpoints of the node's own segments
  PointCloud ceded;         ///< points of other objects inside the node's box, in its frame
  double max_range = -1.0;  ///< m, the least of sensor and label; negative: none
  bool bounded = true;
};

/// Updates m_i with (z', o'_z) of Eq. 12, inside the node's box grown by the new points (Section IV-B).
ScanUpdateReport updateNodeMap(const NodeUpdate& update, const Measurement& z, const ScanUpdate& engine);

}  // namespace hoctomap
