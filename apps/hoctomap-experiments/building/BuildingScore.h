// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "hoctomap/hierarchy/MapHierarchy.h"
#include "hoctomap/simulation/Scene.h"

namespace hoctomap {

/// How many of the solids of a label a map has as nodes of that label.
struct BuildingScore {
  std::size_t solids = 0;
  std::size_t nodes = 0;
  std::size_t matched = 0;
  std::vector<std::string> mistakes;  ///< one line each: missed, and what is too much

  [[nodiscard]] double precision() const;
  [[nodiscard]] double recall() const;
};

/// A node is a solid's if their boxes (along the world's axes; of the solid's surface, and of the node's
/// occupied voxels without the outermost 2 % on each side) overlap by at least a quarter of their union and
/// their centres are within 3 cm (objects; 15 cm for tables, of which the camera does not see all sides). One
/// to one, the largest overlap first.
[[nodiscard]] BuildingScore scoreBuilding(const MapHierarchy& map, const Scene& scene, SolidLabel label);

}  // namespace hoctomap
