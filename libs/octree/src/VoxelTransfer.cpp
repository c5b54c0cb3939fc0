// SPDX-License-Identifier: BSD-3-Clause
#include "VoxelTransfer.h"

#include "SubtreeUpdate.h"
#include "TreeAccess.h"

namespace hoctomap::engine {

namespace {

class VoxelTaker {
 public:
  VoxelTaker(octomap::OcTree& tree, const std::function<bool(const octomap::OcTreeKey&)>& which,
             const std::function<void(const octomap::OcTreeKey&, float)>& take)
      : tree_(tree), which_(which), take_(take), subtree_(OccupancyOdds(tree)) {}

  void run() {
    Node* const root = TreeAccess::rootOf(tree_);
    if (root == nullptr) return;
    TreeAccess::sizeChanged(tree_) = true;
    if (!leaves(*root, kTreeLevels, octomap::OcTreeKey(0, 0, 0))) {
      tree_.clear();
      return;
    }
    auto& size = TreeAccess::sizeOf(tree_);
    size = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(size) + subtree_.grown() - deleted_);
  }

 private:
  /// Whether anything is left of a node `level` levels above the voxels, whose first voxel has the key.
  bool leaves(Node& node, unsigned level, const octomap::OcTreeKey& first) {
    if (!tree_.isNodeOccupied(node)) return true;  // an inner node is as occupied as its most occupied child
    if (!hasChildren(node)) {
      if (level == 0) {
        if (!which_(first)) return true;
        take_(first, node.getLogOdds());
        return false;
      }
      subtree_.expand(node);
    }
    auto**& children = NodeAccess::childrenOf(node);
    bool any = false;
    for (unsigned octant = 0; octant < kOctants; ++octant) {
      auto* const below = static_cast<Node*>(children[octant]);
      if (below == nullptr) continue;
      if (leaves(*below, level - 1, childKey(first, level, octant))) {
        any = true;
        continue;
      }
      delete below;
      children[octant] = nullptr;
      ++deleted_;
    }
    if (any) {
      subtree_.settle(node);
    } else {
      delete[] children;
      children = nullptr;
    }
    return any;
  }

  octomap::OcTree& tree_;
  const std::function<bool(const octomap::OcTreeKey&)>& which_;
  const std::function<void(const octomap::OcTreeKey&, float)>& take_;
  SubtreeUpdate subtree_;
  std::ptrdiff_t deleted_ = 0;
};

}  // namespace

void takeVoxels(octomap::OcTree& tree, const std::function<bool(const octomap::OcTreeKey&)>& which,
                const std::function<void(const octomap::OcTreeKey&, float)>& take) {
  VoxelTaker(tree, which, take).run();
}

}  // namespace hoctomap::engine
