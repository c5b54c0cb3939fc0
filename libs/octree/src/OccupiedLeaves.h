// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "TreeAccess.h"

namespace hoctomap::engine {

/// Calls `visit(first, level)` for each occupied leaf `level` levels above the voxels, whose first voxel has
/// the key, in the order of octomap's leaf iterator. Branches without any are not entered: an inner node is
/// as occupied as its most occupied child. Nor are those for which `enter(first, level)` is false.
template <typename Visit, typename Enter>
class OccupiedLeaves {
 public:
  OccupiedLeaves(const octomap::OcTree& tree, const Visit& visit, const Enter& enter)
      : tree_(tree), visit_(visit), enter_(enter) {
    if (const Node* root = tree.getRoot()) walk(*root, kTreeLevels, octomap::OcTreeKey(0, 0, 0));
  }

 private:
  void walk(const Node& node, unsigned level, const octomap::OcTreeKey& first) {
    if (!tree_.isNodeOccupied(node) || !enter_(first, level)) return;
    bool is_leaf = true;
    if (const auto* const children = NodeAccess::childrenOf(node)) {
      for (unsigned octant = 0; octant < kOctants; ++octant) {
        if (children[octant] == nullptr) continue;
        is_leaf = false;
        walk(static_cast<const Node&>(*children[octant]), level - 1, childKey(first, level, octant));
      }
    }
    if (is_leaf) visit_(first, level);
  }

  const octomap::OcTree& tree_;
  const Visit& visit_;
  const Enter& enter_;
};

}  // namespace hoctomap::engine
