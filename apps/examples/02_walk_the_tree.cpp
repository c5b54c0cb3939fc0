// SPDX-License-Identifier: BSD-3-Clause
// Reads a map directory and walks its tree: what each node is, where it stands, and its octree's voxels.
//   example_02_walk_the_tree MAP
#include <hoctomap/io/MapReader.h>

#include <iostream>

using namespace hoctomap;

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: example_02_walk_the_tree MAP\n";
    return 2;
  }
  try {
    const StoredMap stored = readMap(argv[1]);  // checks every octree against its hash
    const MapHierarchy& map = stored.hierarchy;
    for (const NodeId id : map.preorder()) {  // parents before children
      const MapNode& node = map.node(id);
      // The octree is a stock octomap::OcTree in the node's own frame.
      const octomap::OcTree& tree = node.map().tree();
      std::size_t occupied = 0;
      Eigen::Vector3d highest(0.0, 0.0, -1e9);  // in the world
      const Eigen::Isometry3d world_T_node = toIsometry(map.world_T_node(id));
      for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
        if (!tree.isNodeOccupied(*leaf)) continue;
        ++occupied;
        const Eigen::Vector3d p = world_T_node * Eigen::Vector3d(leaf.getX(), leaf.getY(), leaf.getZ());
        if (p.z() > highest.z()) highest = p;
      }
      std::cout << std::string(2 * map.depth(id), ' ') << id.value << " " << node.label().name << ", "
                << tree.getResolution() << " m, existence " << node.existence() << ", " << occupied
                << " occupied leaves";
      if (occupied > 0) std::cout << ", up to z = " << highest.z();
      std::cout << "\n";
    }
  } catch (const std::exception& e) {
    std::cerr << e.what() << "\n";
    return 1;
  }
}
