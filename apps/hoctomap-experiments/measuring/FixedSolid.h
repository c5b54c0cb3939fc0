// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "hoctomap/geometry/Pose.h"
#include "hoctomap/simulation/Scene.h"
#include "hoctomap/simulation/Shape.h"

namespace hoctomap {

/// Adds a solid that stands on its own, not on another one: floor, wall or table. Others can stand on a
/// table.
SolidId addFixedSolid(Scene& scene, const std::string& name, const Shape& shape, const Pose& world_T_solid,
                      SolidLabel label);

}  // namespace hoctomap
