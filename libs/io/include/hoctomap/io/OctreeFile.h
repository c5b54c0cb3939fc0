// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "hoctomap/octree/VoxelExtent.h"

namespace hoctomap {

/// The stock `.ot` file of a tree (full probabilities), in memory: OctoMap's own file writing does not notice
/// a full disk.
[[nodiscard]] std::string otBytes(const octomap::OcTree& tree);

/// The stock `.bt` file (maximum likelihood) of a tree, which stays as it is: OctoMap's writer changes it.
[[nodiscard]] std::string btBytes(const octomap::OcTree& tree);

/// Both, and what they hold: the tree itself is gone through once.
struct OctreeFiles {
  std::string ot;
  std::string bt;
  VoxelExtent extent;
  std::uint64_t memory_bytes = 0;  ///< the tree's memoryUsage()
};
[[nodiscard]] OctreeFiles octreeFiles(const octomap::OcTree& tree);

/// Checks the bytes of an `.ot` file without recursion: strict header, depth at most 16, exactly the
/// announced number of nodes, nothing after them, finite log-odds. OctoMap's own reader takes truncated files
/// silently and overflows the stack on hostile ones.
/// @throws MapError, beginning with `name`.
void checkOt(std::string_view bytes, const std::string& name);

/// The same for a `.bt` file.
void checkBt(std::string_view bytes, const std::string& name);

/// The tree of an `.ot` file, checked first. `resolution`: the exact one (the header has six digits).
/// @throws MapError, beginning with `name`, also if the header's resolution is another one.
[[nodiscard]] std::unique_ptr<octomap::OcTree> parseOt(std::string_view bytes, double resolution,
                                                       const std::string& name);

}  // namespace hoctomap
