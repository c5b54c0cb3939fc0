// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace hoctomap {

/// A figure at resolution r, by the law that it grows with the same factor from 2 r to r as it did from 4 r
/// to 2 r: a power law whose exponent is that of the last step. Surfaces give a factor of 4, volumes 8; where
/// voxels become finer than the distance of neighbouring beams, free space ceases to be pruned and memory
/// grows faster for a step.
[[nodiscard]] double predictFiner(double at_4r, double at_2r);

/// The time for all scans from that of a part of them, by the number of points.
[[nodiscard]] double predictAll(double part_seconds, std::size_t part_points, std::size_t all_points);

}  // namespace hoctomap
