// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "hoctomap/simulation/Simulation.h"

namespace hoctomap {

/// How large a building is, and how long the walk through it.
struct BuildingPlan {
  std::uint64_t seed = 1;
  int rooms = 12;  ///< along both sides of a corridor: an even number
  int tables = 40;
  int objects = 300;
  int scans = 2000;
  int width = 320;  ///< pixels of an image, whose height is 3/4 of it
};

/// Rooms of 5 x 5 m with up to four tables each (one of them against a wall), a corridor, and things that
/// stand apart on the tables: boxes, tins, mugs, bowls. A camera at 1.45 m walks from room to room, up one
/// side of the corridor and down the other, and around every table by 120 degrees. The same seed, the same
/// building.
/// @throws ConfigError if the plan makes no sense.
[[nodiscard]] Simulation makeBuilding(const BuildingPlan& plan);

}  // namespace hoctomap
