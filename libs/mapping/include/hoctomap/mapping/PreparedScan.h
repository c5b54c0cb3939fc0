// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "hoctomap/geometry/Obb.h"
#include "hoctomap/hierarchy/Label.h"
#include "hoctomap/hierarchy/NodeId.h"
#include "hoctomap/mapping/ScanSeams.h"
#include "hoctomap/mapping/Segmentation.h"

namespace hoctomap {

/// A segment with its label, and what association asks of it.
struct LabelledPart {
  Structure structure;
  PointIndices points;
  PointCloud world_points;
  Label label;
  Obb box;
  std::optional<NodeId> moved_node;     ///< known to be here now: it takes the segment wherever its box is
  NodeId node;                          ///< that took it
  bool is_new = false;                  ///< it shows no known node, whatever boxes say
  bool is_divided = false;              ///< of a segment of S that holds parts of others, too
  std::optional<NodeId> joined_with{};  ///< of a part of a segment that this node's part is the main one of
};

/// A scan after the first step of its integration, which does not depend on the map: S(z) and L(z).
struct PreparedScan {
  std::vector<LabelledPart> parts;
  ScanSeams seams;            ///< between the parts; empty without `seam_votes`
  double seconds = 0.0;       ///< wall time that S and L took
  double seam_seconds = 0.0;  ///< and what the scan says of seams
};

}  // namespace hoctomap
