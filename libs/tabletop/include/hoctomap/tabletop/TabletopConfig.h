// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace hoctomap {

/// How objects on a table are told apart: by their distance (the paper), or cut at concave creases and steps
/// of the surface.
enum class SegmentationMethod { euclidean, convex_patches };

/// Parameters of the segmentation S' (Section IV-A); metres, degrees.
struct TabletopSegmentationConfig {
  SegmentationMethod method = SegmentationMethod::convex_patches;

  // Tables
  double table_height_min = 0.5;   ///< m, z of a table's centre in the world
  double table_height_max = 1.0;   ///< m
  double plane_tolerance = 0.004;  ///< m, what a table departs from its plane; the noise is added to it
  double plane_max_tilt = 5.0;     ///< degrees between a table's normal and gravity
  double min_table_area = 0.05;    ///< m^2 of cells in which the surface itself is seen
  double outline_cell = 0.02;      ///< m, cell of a table's outline
  int ransac_draws = 500;          ///< per plane
  std::uint64_t seed = 1;          ///< of the draws

  // Objects
  double cluster_tolerance = 0.01;    ///< m, Euclidean distance that joins two object points
  double object_height_max = 0.6;     ///< m above the table; what reaches higher is background
  double object_size_max = 1.0;       ///< m, horizontal extent; what is wider is background
  double min_object_height = 0.0025;  ///< m above the table around it; what rises less is the table's
  double min_object_size = 0.02;      ///< m, largest extent of the smallest object
  int min_cluster_points = 50;        ///< smaller clusters are left to the background
  double object_noise_max = 0.03;  ///< m; where the noise (three sigma) is larger, objects are not told apart
  double contact_height = 0.03;    ///< m above the table at which an object must begin

  /// Whether points over a table that are in no cluster go to the object or table they lie on; otherwise, as
  /// in the paper, to the background.
  bool attach_strays = true;

  /// 1/m: the standard deviation of a range r is `range_noise` r^2. 0.0015 is a structured-light camera.
  double range_noise = 0.0015;

  /// Three standard deviations of the range, in metres.
  [[nodiscard]] double noise(double range) const { return 3.0 * range_noise * range * range; }
  /// Distance from its plane up to which a point belongs to a horizontal surface `drop` metres below the
  /// sensor. The noise is along the beam, so that a surface seen at a grazing angle is sharp in height.
  [[nodiscard]] double surfaceTolerance(double range, double drop) const {
    return plane_tolerance + noise(range) * std::min(1.0, std::abs(drop) / std::max(range, 1e-3));
  }
  /// No less than `surfaceTolerance` at the root of `squared_range`, whatever the drop: spares most points of
  /// a scan the square root.
  [[nodiscard]] double largestTolerance(double squared_range) const {
    constexpr double kRounding = 1.0 + 1e-9;
    return (plane_tolerance + 3.0 * range_noise * squared_range) * kRounding;
  }
  /// Height above the table from which a point at this range is more than a bent table or a cable, whatever
  /// is around it.
  [[nodiscard]] double certainHeight(double range) const {
    return std::max(0.025, min_object_height) + noise(range);
  }
  /// How far a region must stand above the table around it, `drop` metres below the sensor. Averages over
  /// many pixels take away what is by chance in a range, but not what neighbouring pixels have in common,
  /// which is as large.
  [[nodiscard]] double leastRise(double range, double drop) const {
    return std::max(min_object_height, surfaceTolerance(range, drop) - plane_tolerance);
  }
};

}  // namespace hoctomap
