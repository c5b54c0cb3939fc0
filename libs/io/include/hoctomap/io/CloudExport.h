// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {

/// The occupied voxels of all nodes as points in the world: x, y, z (m), colour by label, `label` (number of
/// the label, as the comments at the top say), `node` (its id), `probability` of being occupied. A pruned
/// leaf gives a point for every voxel that it covers. Same map, same bytes.
[[nodiscard]] std::string plyOf(const MapHierarchy& hierarchy);  ///< binary, little endian
[[nodiscard]] std::string pcdOf(const MapHierarchy& hierarchy);  ///< version 0.7, binary

}  // namespace hoctomap
