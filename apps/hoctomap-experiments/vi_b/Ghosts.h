// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "hoctomap/geometry/Measurement.h"
#include "hoctomap/mapping/UpdateReport.h"
#include "vi_b/CellSet.h"

namespace hoctomap {

/// Where an object was that is gone, and what is still there.
///
/// A ghost is an occupied voxel of a map that
///  1. lies where the object was: within one voxel of the object's occupied voxels, as its node had them
///  last;
///  2. is no surface that is there now: no point that was measured since then lies within one voxel of it,
///  and
///     no table (which is hidden below and behind things all the same).
class VacatedPlace {
 public:
  /// @param gone the object's node
  /// @param now the hierarchy without it
  /// @param scans_since measured after the object was taken away
  /// Hierarchy and scans must outlive the place.
  VacatedPlace(const RemovedNode& gone, const MapHierarchy& now, const std::vector<Measurement>& scans_since);

  /// @param voxel edge of the voxel, m
  [[nodiscard]] bool isGhost(const Eigen::Vector3d& world_center, double voxel) const;

  /// Centres of the ghosts in the world, over all nodes of a map but its tables.
  [[nodiscard]] PointCloud ghostsOf(const MapHierarchy& map) const;

  /// How many of the points no depth image since then has seen through: something stands in front of them, so
  /// that no number of scans from there takes them away. (The others need more scans.)
  [[nodiscard]] std::size_t countHidden(const PointCloud& world_points) const;

 private:
  [[nodiscard]] bool isHidden(const Eigen::Vector3d& world_point) const;
  [[nodiscard]] bool atTable(const Eigen::Vector3d& world_point) const;

  struct Table {
    Eigen::Isometry3d node_T_world;
    const octomap::OcTree* tree;
  };

  double resolution_;
  CellSet object_;
  CellSet measured_;
  std::vector<Table> tables_;
  struct View {
    Eigen::Isometry3d sensor_T_world;
    const DepthImage* image;
  };
  std::vector<View> views_;
};

}  // namespace hoctomap
