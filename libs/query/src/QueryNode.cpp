// SPDX-License-Identifier: BSD-3-Clause
#include "QueryNode.h"

#include "hoctomap/geometry/Pose.h"

namespace hoctomap {

QueryNode::QueryNode(const MapHierarchy& map, NodeId node_id)
    : id(node_id), depth(map.depth(node_id)), tree(&map.node(node_id).map().tree()) {
  resolution = tree->getResolution();
  voxels_per_metre = 1.0 / resolution;
  occupied_log_odds = tree->getOccupancyThresLog();
  existence = map.node(node_id).existence();
  world_T_node = toIsometry(map.world_T_node(node_id));
  node_T_world = world_T_node.inverse();
  top = OctreeCell::rootOf(*tree);
  if (top.node == nullptr) return;
  measure(top);
  known_world = worldBounds({world_T_node, known});
  if (!occupied.isEmpty()) occupied_world = worldBounds({world_T_node, occupied});
  // The upper levels hold one child each: all that is known lies in a small part of what a tree can address.
  while (!top.isLeaf(*tree)) {
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

void QueryNode::measure(const OctreeCell& cell) {
  if (cell.isLeaf(*tree)) {
    const Eigen::AlignedBox3d cube = cell.cube(resolution);
    known.extend(cube);
    if (!isOccupied(cell)) return;
    occupied.extend(cube);
    const auto edge = static_cast<std::uint64_t>(cell.edge);
    occupied_voxels += edge * edge * edge;
    return;
  }
  for (unsigned octant = 0; octant < OctreeCell::kOctants; ++octant) {
    const OctreeCell child = cell.child(*tree, octant);
    if (child.node != nullptr) measure(child);
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
