// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <Eigen/Geometry>

namespace hoctomap {

/// A cube of an octree, in voxels of its resolution: [low, low + edge) along each axis, 0 at the origin of
/// the frame. Without a tree node nothing is known of it.
struct OctreeCell {
  static constexpr int kHalfEdge = 32768;  ///< voxels, of the whole tree
  static constexpr unsigned kOctants = 8;

  const octomap::OcTreeNode* node = nullptr;
  Eigen::Array3i low = Eigen::Array3i::Constant(-kHalfEdge);
  int edge = 2 * kHalfEdge;

  [[nodiscard]] static OctreeCell rootOf(const octomap::OcTree& tree) {
    OctreeCell cell;
    cell.node = tree.getRoot();
    return cell;
  }
  [[nodiscard]] bool isLeaf(const octomap::OcTree& tree) const {
    return edge == 1 || !tree.nodeHasChildren(node);
  }
  /// @param octant bit 0: upper half in x, 1: y, 2: z
  [[nodiscard]] OctreeCell child(const octomap::OcTree& tree, unsigned octant) const {
    OctreeCell cell;
    cell.edge = edge / 2;
    const int bits = static_cast<int>(octant);
    cell.low = low + cell.edge * Eigen::Array3i(bits & 1, bits >> 1 & 1, bits >> 2 & 1);
    cell.node = tree.nodeChildExists(node, octant) ? tree.getNodeChild(node, octant) : nullptr;
    return cell;
  }
  /// In the frame of the octree, m.
  [[nodiscard]] Eigen::AlignedBox3d cube(double resolution) const {
    return {resolution * low.cast<double>().matrix(), resolution * (low + edge).cast<double>().matrix()};
  }
};

}  // namespace hoctomap
