// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {

/// Those of the nodes that a surface is a part of, or that are a part of it: a tenth of it lies on their
/// surface, or half of their surface on it. Boxes would not do: those of two tables that stand at an angle
/// meet.
/// @param world_points  the surface that a scan shows as one, in the world
[[nodiscard]] std::vector<NodeId> bridgedNodes(const MapHierarchy& hierarchy, std::span<const NodeId> nodes,
                                               std::span<const Eigen::Vector3f> world_points);

}  // namespace hoctomap
