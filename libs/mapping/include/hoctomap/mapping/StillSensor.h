// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "hoctomap/geometry/Pose.h"

namespace hoctomap {

/// Since when the sensor has stood where it is. Between scans from one place there is no error of poses: what
/// such scans made of an object, another one must show at the very same pixels.
struct StillSensor {
  Pose world_T_sensor;
  std::uint64_t since_scan = 0;

  /// Whether a sensor with this pose has not moved. What is below a micrometre and a microradian is rounding.
  [[nodiscard]] bool isAt(const Pose& pose) const {
    constexpr double kRounding = 1e-6;
    return (toIsometry(pose).matrix() - toIsometry(world_T_sensor).matrix()).cwiseAbs().maxCoeff() <
           kRounding;
  }
};

}  // namespace hoctomap
