// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "hoctomap/geometry/Pose.h"

namespace hoctomap {

/// MRPT's text of a pose, `[x y z yaw pitch roll]` in metres and degrees, with all digits. It depends on the
/// matrix of the pose only, so that a pose that was read from a file has the text it was written with.
[[nodiscard]] std::string poseText(const Pose& pose);

/// The pose of such a text; nothing if it is none.
[[nodiscard]] std::optional<Pose> parsePoseText(std::string_view text);

/// The 16 numbers of the homogeneous matrix, row by row.
[[nodiscard]] std::array<double, 16> matrixNumbers(const Pose& pose);

/// The pose with exactly these numbers.
/// @throws std::invalid_argument if they are no rigid transform.
[[nodiscard]] Pose poseFromNumbers(const std::array<double, 16>& numbers);

/// Whether two poses are the same up to `tolerance` in every number of their matrices.
[[nodiscard]] bool nearlyEqual(const Pose& a, const Pose& b, double tolerance);

}  // namespace hoctomap
