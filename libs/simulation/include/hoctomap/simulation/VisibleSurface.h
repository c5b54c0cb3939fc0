// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <unordered_set>

#include "hoctomap/simulation/Simulation.h"

namespace hoctomap {

/// What has been seen so far of each table and object: the part of its surface that a perfect map would hold.
/// Gathered as voxels in the solid's own frame, so that it moves with the solid.
class VisibleSurface {
 public:
  explicit VisibleSurface(double voxel_size = 0.002) : voxel_size_(voxel_size) {}

  /// Adds the true surface points of all returns.
  void add(const SimulatedScan& scan);

  [[nodiscard]] std::size_t voxels(SolidId id) const;
  /// Mean of the voxel centres in the solid's frame; nothing if it was never seen.
  [[nodiscard]] std::optional<Eigen::Vector3d> centroid(SolidId id) const;

 private:
  struct Seen {
    std::unordered_set<std::uint64_t> voxels;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  };

  double voxel_size_;
  std::map<SolidId, Seen> seen_;

  void addPoint(Seen& seen, const Eigen::Vector3d& solid_point) const;
};

}  // namespace hoctomap
