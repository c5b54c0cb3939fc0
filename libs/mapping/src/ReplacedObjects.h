// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "hoctomap/hierarchy/MapHierarchy.h"
#include "hoctomap/mapping/Reidentification.h"

namespace hoctomap {

/// Whether the segment that falls into a node's box is another object in its place. Beams that ended on the
/// node may end on what replaced it just as well, so the question is asked the other way round: if beams of
/// earlier scans went through much of where the segment is, it is registered to the node.
/// @param world_points  of the segment
/// @param range         m, at which it is seen
[[nodiscard]] bool isReplaced(const MapHierarchy& hierarchy, NodeId id, const PointCloud& world_points,
                              double range, const ReidentificationConfig& config);

}  // namespace hoctomap
