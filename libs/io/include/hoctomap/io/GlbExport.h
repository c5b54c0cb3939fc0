// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {

/// The map as binary glTF 2.0: a node of the file for every node of the map, named `object 3`, at its pose
/// below its parent, with the surface of its voxels in the colour of its label; `extras` say id, label,
/// resolution and existence. The scene's root turns z up to glTF's y up. Same map, same bytes.
/// @throws LimitError beyond 4 GiB
[[nodiscard]] std::string glbOf(const MapHierarchy& hierarchy);

}  // namespace hoctomap
