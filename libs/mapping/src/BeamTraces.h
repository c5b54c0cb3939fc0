// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {

/// A node's map as the record of where beams have passed.
class BeamTraces {
 public:
  BeamTraces(const MapHierarchy& hierarchy, NodeId id);

  /// Whether beams passed the place.
  [[nodiscard]] bool isFree(const Eigen::Vector3f& world_point) const;
  /// Whether beams passed the place or ended there.
  [[nodiscard]] bool isKnown(const Eigen::Vector3f& world_point) const;
  /// Whether an occupied voxel may lie within `distance` metres; certainly true if one does.
  [[nodiscard]] bool mayBeNearSurface(const Eigen::Vector3f& world_point, double distance) const;

  /// Centre of the voxel that the place lies in.
  [[nodiscard]] Eigen::Vector3f voxelCentre(const Eigen::Vector3f& world_point) const;
  /// m; a voxel that a surface crosses is free in part.
  [[nodiscard]] double voxelDiagonal() const;

 private:
  const octomap::OcTree& tree_;
  Eigen::Isometry3f node_T_world_;
};

}  // namespace hoctomap
