// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>

#include "OctreeCell.h"
#include "hoctomap/geometry/Obb.h"
#include "hoctomap/hierarchy/NodeSource.h"

namespace hoctomap {

/// A map node, made ready for questions: what does not depend on the question is worked out once.
struct QueryNode {
  QueryNode(const NodePlace& place, std::shared_ptr<const NodeMap> node_map);

  NodeId id;
  std::shared_ptr<const NodeMap> map;
  const octomap::OcTree* tree = nullptr;
  double resolution = 0.0;         ///< m
  double voxels_per_metre = 0.0;   ///< as octomap computes keys
  float occupied_log_odds = 0.0F;  ///< from here on a voxel is occupied
  double existence = 0.5;
  Eigen::Isometry3d world_T_node;
  Eigen::Isometry3d node_T_world;
  OctreeCell top;                     ///< the smallest cell that holds all that is known
  Eigen::AlignedBox3d known;          ///< of all known voxels, in the node's frame
  std::uint64_t occupied_voxels = 0;  ///< at the node's resolution

  /// An inner node of OctoMap is as likely as its likeliest child: false excludes all that is below, too.
  [[nodiscard]] bool isOccupied(const OctreeCell& cell) const {
    return cell.node->getLogOdds() >= occupied_log_odds;
  }

  /// The voxel around a point of the node's frame; null where nothing is known.
  [[nodiscard]] const octomap::OcTreeNode* voxelAt(const Eigen::Vector3d& node_point) const;

  /// Goes through the occupied leaves below `cell`: `enter(cell)` says whether one is of interest,
  /// `visit(leaf)` whether to go on. Returns false if a visit ended it.
  template <class Enter, class Visit>
  bool forEachOccupiedLeaf(const OctreeCell& cell, const Enter& enter, const Visit& visit) const {
    if (cell.node == nullptr || !isOccupied(cell) || !enter(cell)) return true;
    if (cell.isLeaf(*tree)) return visit(cell);
    for (unsigned octant = 0; octant < OctreeCell::kOctants; ++octant) {
      if (!forEachOccupiedLeaf(cell.child(*tree, octant), enter, visit)) return false;
    }
    return true;
  }
};

}  // namespace hoctomap
