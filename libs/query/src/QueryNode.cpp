// SPDX-License-Identifier: BSD-3-Clause
#include "QueryNode.h"

#include <utility>

namespace hoctomap {

QueryNode::QueryNode(const NodePlace& place, std::shared_ptr<const NodeMap> node_map)
    : id(place.id), map(std::move(node_map)), tree(&map->tree()) {
  resolution = tree->getResolution();
  voxels_per_metre = 1.0 / resolution;
  occupied_log_odds = tree->getOccupancyThresLog();
  existence = place.existence;
  world_T_node = place.world_T_node;
  node_T_world = world_T_node.inverse();
  known = place.extent.known;
  occupied_voxels = place.extent.voxels.occupied;
  top = OctreeCell::rootOf(*tree);
  // The upper levels hold one child each: all that is known lies in a small part of what a tree can address.
  while (top.node != nullptr && !top.isLeaf(*tree)) {
    OctreeCell only;
    unsigned children = 0;
    for (unsigned octant = 0; octant < OctreeCell::kOctants; ++octant) {
      const OctreeCell child = top.child(*tree, octant);
      if (child.node == nullptr) continue;
      only = child;
      ++children;
    }
    if (children != 1) break;
    top = only;
  }
}

const octomap::OcTreeNode* QueryNode::voxelAt(const Eigen::Vector3d& node_point) const {
  if (!known.contains(node_point)) return nullptr;
  const Eigen::Array3d voxel = (voxels_per_metre * node_point.array()).floor();
  const Eigen::Array3i key = voxel.cast<int>() - top.low;
  if ((key < 0).any() || (key >= top.edge).any()) return nullptr;  // on the upper face of all that is known
  const octomap::OcTreeNode* node = top.node;
  for (int half = top.edge / 2; half > 0; half /= 2) {
    const unsigned octant = ((key.x() & half) != 0 ? 1U : 0U) | ((key.y() & half) != 0 ? 2U : 0U) |
                            ((key.z() & half) != 0 ? 4U : 0U);
    if (!tree->nodeChildExists(node, octant)) return tree->nodeHasChildren(node) ? nullptr : node;
    node = tree->getNodeChild(node, octant);
  }
  return node;
}

}  // namespace hoctomap
