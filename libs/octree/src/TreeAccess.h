// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

namespace hoctomap::engine {

/// What octomap keeps protected and a bulk update needs. A derived class may name these members; no object of
/// the derived classes ever exists.
class NodeAccess : public octomap::OcTreeNode {
 public:
  /// Array of eight children, each of which may be null; null if there is no array.
  static octomap::AbstractOcTreeNode**& childrenOf(octomap::OcTreeNode& node) {
    return node.*(&NodeAccess::children);
  }
};

class TreeAccess : public octomap::OcTree {
 public:
  static octomap::OcTreeNode*& rootOf(octomap::OcTree& tree) { return tree.*(&TreeAccess::root); }
  static std::size_t& sizeOf(octomap::OcTree& tree) { return tree.*(&TreeAccess::tree_size); }
  static bool& sizeChanged(octomap::OcTree& tree) { return tree.*(&TreeAccess::size_changed); }
};

}  // namespace hoctomap::engine
