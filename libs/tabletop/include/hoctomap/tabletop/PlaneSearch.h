// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "hoctomap/geometry/Measurement.h"
#include "hoctomap/tabletop/TabletopConfig.h"

namespace hoctomap {

using Plane = Eigen::Hyperplane<double, 3>;

/// A small piece of surface that could belong to a table: the points of one voxel, which lie on a nearly
/// horizontal plane. The search works on these, so that near and far tables count by their area and not by
/// their points, and walls do not count at all.
struct Surfel {
  static constexpr double kSize = 0.05;  ///< m, edge of the voxel
  Eigen::Vector3d centroid;              ///< world
  double tolerance = 0.0;                ///< m, distance from a plane up to which it supports it
};

/// The horizontal surfels within the band of table heights, widened by 5 cm on both sides for tilted tables.
[[nodiscard]] std::vector<Surfel> horizontalSurfels(const Measurement& z,
                                                    const TabletopSegmentationConfig& config);

/// The nearly horizontal plane with the most surfels (RANSAC with triples drawn by `rng`, normal upwards
/// within `plane_max_tilt` of z), refitted to them; nothing if no triple spans such a plane.
[[nodiscard]] std::optional<Plane> dominantPlane(std::span<const Surfel> surfels,
                                                 const TabletopSegmentationConfig& config,
                                                 std::mt19937_64& rng);

/// Least-squares plane (total, all points alike) with its normal upwards; nothing for points on a line or
/// if it tilts by more than `plane_max_tilt`.
[[nodiscard]] std::optional<Plane> regressionPlane(std::span<const Eigen::Vector3d> points,
                                                   const TabletopSegmentationConfig& config);

}  // namespace hoctomap
