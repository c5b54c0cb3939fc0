// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <cstdint>

namespace hoctomap::engine {

/// What octomap keeps protected and a bulk update needs. A derived class may name these members; no object of
/// the derived classes ever exists.
class NodeAccess : public octomap::OcTreeNode {
 public:
  /// Array of eight children, each of which may be null; null if there is no array.
  static octomap::AbstractOcTreeNode**& childrenOf(octomap::OcTreeNode& node) {
    return node.*(&NodeAccess::children);
  }
  static octomap::AbstractOcTreeNode* const* childrenOf(const octomap::OcTreeNode& node) {
    return node.*(&NodeAccess::children);
  }
};

class TreeAccess : public octomap::OcTree {
 public:
  static octomap::OcTreeNode*& rootOf(octomap::OcTree& tree) { return tree.*(&TreeAccess::root); }
  static std::size_t& sizeOf(octomap::OcTree& tree) { return tree.*(&TreeAccess::tree_size); }
  static bool& sizeChanged(octomap::OcTree& tree) { return tree.*(&TreeAccess::size_changed); }
};

using Node = octomap::OcTreeNode;

inline constexpr unsigned kTreeLevels = 16;
inline constexpr unsigned kOctants = 8;

/// Key of the first voxel of a child of a node `level` levels above the voxels.
inline octomap::OcTreeKey childKey(const octomap::OcTreeKey& first, unsigned level, unsigned octant) {
  octomap::OcTreeKey key = first;
  for (unsigned axis = 0; axis < 3; ++axis)
    key[axis] = static_cast<octomap::key_type>(key[axis] + ((octant >> axis & 1U) << (level - 1)));
  return key;
}

inline Node* child(Node& node, unsigned octant) {
  auto* const* children = NodeAccess::childrenOf(node);
  return children == nullptr ? nullptr : static_cast<Node*>(children[octant]);
}

inline bool hasChildren(Node& node) {
  auto* const* children = NodeAccess::childrenOf(node);
  if (children == nullptr) return false;
  std::uintptr_t any = 0;  // without a branch for each
  for (unsigned i = 0; i < kOctants; ++i) any |= reinterpret_cast<std::uintptr_t>(children[i]);
  return any != 0;
}

inline octomap::AbstractOcTreeNode** childrenOrNew(Node& node) {
  auto**& children = NodeAccess::childrenOf(node);
  if (children == nullptr) children = new octomap::AbstractOcTreeNode*[kOctants]();
  return children;
}

}  // namespace hoctomap::engine
