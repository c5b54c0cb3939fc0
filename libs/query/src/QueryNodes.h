// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "BoxIndex.h"
#include "QueryNode.h"
#include "hoctomap/query/HierarchyQuery.h"

namespace hoctomap {

/// What stands behind a HierarchyQuery: the nodes in the order in which they decide, and where they are.
class HierarchyQuery::Nodes {
 public:
  explicit Nodes(std::vector<QueryNode> in_order);

  const std::vector<QueryNode> all;
  const BoxIndex known;          ///< boxes of the known voxels in the world, by index in `all`
  const BoxIndex occupied;       ///< of the occupied ones
  Eigen::AlignedBox3d anything;  ///< around all that is known, in the world
};

}  // namespace hoctomap
