// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "hoctomap/simulation/Scene.h"
#include "hoctomap/simulation/Shape.h"
#include "hoctomap/simulation/Simulation.h"

namespace hoctomap::test {

Solid makeSolid(const std::string& name, SolidLabel label, const Shape& shape, const Pose& support_T_solid,
                std::optional<SolidId> support = std::nullopt);

inline Pose at(double x, double y, double z, double yaw = 0.0) {
  return {x, y, z, yaw, 0.0, 0.0};
}

/// A floor, a table of height 0.7 m at (1, 0), and on it a box and a sphere.
struct TableScene {
  Scene scene;
  SolidId floor, table, box, sphere;
};
TableScene tableScene();

/// 80 x 60 pixels, without noise and faults.
RangeSensorModel idealCamera();

/// `tableScene` seen by `idealCamera` from three places.
Simulation tableSimulation();

}  // namespace hoctomap::test
