// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "hoctomap/simulation/Simulation.h"

namespace hoctomap {

/// A table on which boxes, tins, mugs and bowls touch each other and stand on each other, seen from many
/// sides.
struct CrowdedScene {
  std::string name;
  Simulation simulation;
};

/// A random scene; the same seed, the same scene. Between two and four groups of things side by side
/// (touching, or up to 3 mm apart) and on top of each other. Tops side by side differ in height, and what
/// stands on something is narrower, by a centimetre: what is flush shows no seam to anybody.
/// @param views  of the camera, on an arc around the table
[[nodiscard]] CrowdedScene makeCrowdedScene(std::uint64_t seed, int views);

}  // namespace hoctomap
