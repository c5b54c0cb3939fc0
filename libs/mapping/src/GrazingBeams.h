// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "hoctomap/geometry/PointCloud.h"

namespace hoctomap {

/// A node's own beams of one scan, by what they may clear. All in the node's frame.
struct OwnBeams {
  PointCloud hits;       ///< clear up to their endpoint, as in stock OctoMap
  PointCloud endpoints;  ///< of beams that graze their surface
  PointCloud cleared;    ///< up to where such a beam clears
};

/// Keeps beams from clearing the surface that they end on.
///
/// A beam that meets its surface at a flat angle runs through many voxels that hold a part of that surface
/// before it ends in one: where voxels are finer than the distance of neighbouring endpoints, the misses win
/// and flat tops are thinned out (stock OctoMap does that). A voxel that holds a part of a plane is nowhere
/// farther from it than its diagonal d; a beam with angle a to the surface's normal is nearer than d on its
/// last d / cos a. Of that, d (1 / cos a - 1) clears nothing: a beam that meets its surface head-on is left
/// as it is.
///
/// @param points endpoints; @param origin of the beams; @param resolution edge of a voxel, metres.
/// @param max_range m, negative: none. Longer beams have no endpoint and stay hits.
[[nodiscard]] OwnBeams spareSurface(const PointCloud& points, const Eigen::Vector3f& origin,
                                    double resolution, double max_range);

}  // namespace hoctomap
