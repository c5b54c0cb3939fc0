// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <array>
#include <optional>
#include <utility>

#include "VoxelGrid.h"

namespace hoctomap::engine {

/// Least and greatest key of the occupied voxels along each axis, kept while the tree changes. Remembers an
/// outermost voxel for each side: as long as that one is occupied, only what has come since can lie farther
/// out, so that the cost is that of the place that has changed, not that of the tree.
class OccupiedCorners {
 public:
  using Corners = std::pair<octomap::OcTreeKey, octomap::OcTreeKey>;

  /// Voxels of this box may be occupied now, others only have ceased to be.
  void changed(const KeyBox& occupied);

  /// Of the tree whose changes were told; none without an occupied voxel.
  const std::optional<Corners>& of(const octomap::OcTree& tree);

 private:
  bool valid_ = false;
  KeyBox changed_ = kAllKeys;  ///< what may be occupied since `corners_` was valid
  std::optional<Corners> corners_;
  std::array<octomap::OcTreeKey, 6> outermost_{};  ///< least and greatest along x, y, z
};

}  // namespace hoctomap::engine
