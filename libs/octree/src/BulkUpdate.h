// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <span>

#include "BlockView.h"

namespace hoctomap::engine {

/// Updates the tree by the marks of one scan in a single pass: the result of octomap's `updateNode` for each
/// marked voxel, whatever their order.
/// @param blocks in the order of their codes.
void updateTree(octomap::OcTree& tree, std::span<const BlockMarks> blocks);

}  // namespace hoctomap::engine
