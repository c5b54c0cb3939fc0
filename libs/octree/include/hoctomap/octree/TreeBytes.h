// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <cstdint>
#include <string>

#include "hoctomap/octree/VoxelExtent.h"

namespace hoctomap {

/// The nodes of a tree as OctoMap writes them.
struct TreeBytes {
  std::string bytes;         ///< what stands behind the header
  std::uint64_t nodes = 0;   ///< what the header announces
  std::uint64_t leaves = 0;  ///< of them; of `.ot` nodes only
};

/// As `OcTree::write`: log-odds (native byte order) and a mask of children for every node, parents first.
[[nodiscard]] TreeBytes otNodes(const octomap::OcTree& tree);

/// As `OcTree::writeBinary`: free, occupied, or inner, two bits a child, of the tree that `toMaxLikelihood`
/// and `prune` would make of it. Made from the `.ot` nodes, which lie in a row, as those of a tree do not.
/// @param occupied_from  log-odds, the tree's threshold
[[nodiscard]] TreeBytes btNodes(const TreeBytes& ot, float occupied_from);

/// What the tree of these `.ot` nodes knows and where. @param resolution m, edge of a voxel
[[nodiscard]] VoxelExtent extentOf(const TreeBytes& ot, double resolution, float occupied_from);

}  // namespace hoctomap
