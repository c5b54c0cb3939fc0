// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "hoctomap/octree/OccupancyModel.h"
#include "hoctomap/octree/ScanUpdate.h"
#include "hoctomap/octree/VoxelExtent.h"

namespace hoctomap {

namespace engine {
struct KeyBox;
class OccupiedCorners;
}  // namespace engine

/// The map m_i of a node (Eq. 2): an OctoMap octree in the node's own frame.
class NodeMap {
 public:
  /// An empty map. @param resolution voxel edge in metres.
  /// @throws std::invalid_argument if the resolution is not finite and positive.
  NodeMap(double resolution, const OccupancyModel& model);

  /// A map around an existing tree (of a file); sets `model` in it.
  /// @throws std::invalid_argument if the tree is null.
  NodeMap(std::unique_ptr<octomap::OcTree> tree, const OccupancyModel& model);

  NodeMap(NodeMap&&) noexcept;
  NodeMap& operator=(NodeMap&&) noexcept;
  ~NodeMap();

  [[nodiscard]] const octomap::OcTree& tree() const { return *tree_; }
  [[nodiscard]] double resolution() const { return tree_->getResolution(); }
  [[nodiscard]] const OccupancyModel& model() const { return model_; }

  /// Integrates one scan.
  ScanUpdateReport update(const ScanUpdate& engine, const Beams& beams);

  /// Takes over what another map knows: its occupied voxels are added in log-odds, its free voxels only where
  /// this map knows nothing. Voxels are resampled at their centres.
  void absorb(const NodeMap& other, const Eigen::Isometry3d& this_T_other);

  /// Adds what another map knows of the same thing, from other scans: in log-odds, within clamping. With the
  /// identity the sum is exact, voxel by voxel; otherwise the other map is resampled at its voxels' centres,
  /// and its free voxels beside occupied ones, which a turned grid would shift into the surface, do not
  /// count.
  void add(const NodeMap& other, const Eigen::Isometry3d& this_T_other);

  /// Hands over the occupied voxels of which `which` (centre in this map's frame) is true: they are added to
  /// the other map in log-odds, and unknown here afterwards.
  void give(NodeMap& other, const Eigen::Isometry3d& other_T_this,
            const std::function<bool(const Eigen::Vector3f&)>& which);

  /// Takes what a scan has shown to be another object's as evidence against: each occupied voxel that holds
  /// one of the points (in this map's frame), or is beside one that does, loses as much as a hit gives. One
  /// that is not occupied any more is unknown afterwards: nothing was measured there but the other object.
  void cede(const PointCloud& points);

  /// Centres of the occupied voxels in the node's frame, at the map's resolution, in octree order.
  [[nodiscard]] const PointCloud& occupiedVoxels() const;

  /// Those of them that meet a box in the node's frame: looks at no other part of the tree.
  [[nodiscard]] PointCloud occupiedVoxelsIn(const Eigen::AlignedBox3d& box) const;

  /// Box of the occupied voxels in the node's frame (whole voxels, no padding); empty if there are none.
  /// After scans, looks at the outermost of them only, and at what may have become occupied.
  [[nodiscard]] Eigen::AlignedBox3d occupiedBox() const;

  [[nodiscard]] VoxelCounts countVoxels() const { return extent().voxels; }
  /// Looks at every leaf.
  [[nodiscard]] VoxelExtent extent() const;

 private:
  /// @param occupied  keys that may be occupied now and were not before
  void changed(const engine::KeyBox& occupied);

  std::unique_ptr<octomap::OcTree> tree_;
  OccupancyModel model_;
  // Derived from the tree on first use after a change; one thread works on a node at a time.
  mutable bool voxels_valid_ = false;
  mutable PointCloud occupied_voxels_;
  mutable std::unique_ptr<engine::OccupiedCorners> corners_;
};

}  // namespace hoctomap
