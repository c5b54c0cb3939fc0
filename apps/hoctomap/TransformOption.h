// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "hoctomap/geometry/Pose.h"

namespace hoctomap {

/// The value of `--transform`: `x y z yaw pitch roll`, metres and degrees, with or without commas and the
/// brackets of MRPT's own text.
/// @throws ConfigError if it is none
[[nodiscard]] Pose parseTransform(const std::string& text);

}  // namespace hoctomap
