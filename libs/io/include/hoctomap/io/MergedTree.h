// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <memory>

#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {

/// The whole hierarchy as one OctoMap tree in the world frame (docs/decisions/0044).
///
/// At a point, the finest node that knows it decides: p = 1/2 + e (P - 1/2), with its existence e and its
/// voxel's probability P; of equally fine ones that with the largest p. A voxel of the result has the largest
/// p of the points looked at in it, which lie so dense that none is missed; where no node knows anything, it
/// is unknown. Same map, same bytes.
/// @param resolution of the result, metres
/// @throws ConfigError if it is not finite and at least 0.1 mm; LimitError beyond 5 10^8 points to look at
[[nodiscard]] std::unique_ptr<octomap::OcTree> mergedTree(const MapHierarchy& hierarchy, double resolution);

}  // namespace hoctomap
