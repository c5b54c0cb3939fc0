// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "hoctomap/geometry/PointCloud.h"
#include "hoctomap/geometry/Pose.h"

namespace hoctomap {

/// The reference frame of Section IV-A: origin at the centroid, axes along the principal components in order
/// of decreasing variance.
///
/// Properties:
///  1. right-handed and orthonormal;
///  2. deterministic: the first two axes have a positive component of largest magnitude (first of equals),
///  the
///     third is their cross product;
///  3. equivariant under translation;
///  4. degenerate clouds fall back on the world axes where the data leave a choice: fewer than 3 points or an
///     isotropic cloud gives the identity rotation; a line fixes the x axis only; a disc (two equal
///     variances) fixes its normal only.
/// An empty cloud gives the identity.
[[nodiscard]] Pose pcaFrame(std::span<const Eigen::Vector3f> points);

}  // namespace hoctomap
