// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "hoctomap/geometry/Pose.h"

namespace hoctomap {

/// Where a measurement is taken from: a robot whose base stands on the floor, and the camera on it.
struct Viewpoint {
  Pose world_T_base;   ///< on the floor, z up, x where the robot heads
  Pose base_T_sensor;  ///< the camera's mount: x forward, y left, z up

  [[nodiscard]] Pose world_T_sensor() const { return world_T_base + base_T_sensor; }
};

}  // namespace hoctomap
