// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "hoctomap/geometry/PointCloud.h"
#include "hoctomap/mapping/SeamVotes.h"

namespace hoctomap {

/// What one scan says of seams, before it is added to the votes of the others: it does not depend on them.
struct ScanSeams {
  /// A pair of cells that the scan shows both.
  struct Pair {
    std::uint32_t cell;      ///< index
    std::uint8_t direction;  ///< to the other one
    std::int16_t evidence;   ///< for a seam between them
  };

  std::vector<SeamVotes::Cell> cells;  ///< that the scan shows, in order
  std::vector<bool> is_object;         ///< by cell
  std::vector<Pair> pairs;
};

/// S cuts between an object and what it stands on, too: what is thin is an object in one view and a part of
/// its table in the next, and what stands on it must not grow into it.
/// @param segments  the clusters of S, world points
/// @param ground    what they stand on, world points
/// @param origin    of the sensor
[[nodiscard]] ScanSeams scanSeams(std::span<const PointCloud* const> segments,
                                  std::span<const PointCloud* const> ground, const Eigen::Vector3d& origin);

}  // namespace hoctomap
