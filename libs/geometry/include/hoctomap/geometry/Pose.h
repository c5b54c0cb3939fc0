// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Geometry>

#include "hoctomap/geometry/PointCloud.h"

namespace hoctomap {

/// An element of SE(3): metres, radians. `a_T_b` takes coordinates in frame b to frame a;
/// `a_T_b + b_T_c` is the composition, `-a_T_b` the inverse.
using Pose = mrpt::poses::CPose3D;

/// The pose as a rigid transform for work on many points.
[[nodiscard]] Eigen::Isometry3d toIsometry(const Pose& pose);

/// The pose of a 4x4 homogeneous matrix.
/// @throws std::invalid_argument if it is not finite, not orthonormal to 1e-6, a reflection, its last row is
///         not (0, 0, 0, 1), or it is more than 1000 km from the origin.
[[nodiscard]] Pose poseFromMatrix(const Eigen::Matrix4d& matrix);

/// The nearest pose whose rotation is orthonormal to rounding: keeps chains of compositions from drifting.
[[nodiscard]] Pose orthonormalized(const Pose& pose);

/// Points `points[i]` in frame b, given in frame a: `a_T_b` applied in double, rounded once to float.
[[nodiscard]] PointCloud transformed(const Pose& a_T_b, const PointCloud& points);

/// The unit vector that `-gravity` points to, and the rotation that takes it to +z (shortest arc; a half turn
/// about x for -z).
/// @throws std::invalid_argument if `up` is zero or not finite.
[[nodiscard]] Pose levelled(const Eigen::Vector3d& up);

}  // namespace hoctomap
