// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>

#include "hoctomap/geometry/Obb.h"
#include "hoctomap/geometry/PointCloud.h"
#include "hoctomap/geometry/Pose.h"

namespace hoctomap::test {

using Rng = std::mt19937_64;

double uniform(Rng& rng, double low, double high);
Eigen::Vector3d uniformVector(Rng& rng, double low, double high);

/// Any rotation, translation within +-`extent` metres.
Pose randomPose(Rng& rng, double extent);

/// A box with half extents of 1 cm to 1 m, centre within +-`extent` metres.
Obb randomBox(Rng& rng, double extent);

/// Points on the surface of `obb`.
PointCloud boxSurface(Rng& rng, const Obb& obb, std::size_t count);

}  // namespace hoctomap::test
