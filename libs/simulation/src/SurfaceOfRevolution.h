// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "hoctomap/simulation/Shape.h"

namespace hoctomap {

/// Chords per full turn that stay within `tolerance` of a circle.
[[nodiscard]] int segmentsOfCircle(double radius, double tolerance);

/// Turns the polyline (radius, z) about z, with chords within `tolerance` of their circles; points on the
/// axis become poles.
[[nodiscard]] TriangleMesh turn(const std::vector<Eigen::Vector2d>& polyline, double tolerance);

/// The closed outline of a turned shape: outside bottom up, then, if it is hollow, inside top down.
[[nodiscard]] std::vector<Eigen::Vector2d> closedProfile(const TurnedShape& shape);

/// Radius of the profile at height z, interpolated.
[[nodiscard]] double radiusAt(const std::vector<Eigen::Vector2d>& profile, double z);

/// The tube of a handle; its ends lie inside the wall.
[[nodiscard]] TriangleMesh handleTube(const TurnedShape& shape);

}  // namespace hoctomap
