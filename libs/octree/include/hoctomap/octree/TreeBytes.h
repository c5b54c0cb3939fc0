// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <cstdint>
#include <string>

namespace hoctomap {

/// The nodes of a tree as OctoMap writes them.
struct TreeBytes {
  std::string bytes;        ///< what stands behind the header
  std::uint64_t nodes = 0;  ///< what the header announces
};

/// As `OcTree::write`: log-odds and children of every node, in native byte order.
[[nodiscard]] TreeBytes otNodes(const octomap::OcTree& tree);

/// As `OcTree::writeBinary`: free, occupied, or inner, two bits a child, of the tree that
/// `toMaxLikelihood` and `prune` would make of it. The tree is neither copied nor changed.
[[nodiscard]] TreeBytes btNodes(const octomap::OcTree& tree);

}  // namespace hoctomap
