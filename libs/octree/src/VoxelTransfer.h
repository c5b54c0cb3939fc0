// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <functional>

namespace hoctomap::engine {

/// Takes the occupied voxels of which `which` is true out of a tree: they are unknown in it afterwards, and
/// nodes without children are gone with them, which stock `deleteNode` leaves behind. What is left is pruned.
/// @param which   asked of each occupied voxel, in the order of octomap's leaf iterator
/// @param take    called with each voxel that is taken and its log-odds, in the same order
void takeVoxels(octomap::OcTree& tree, const std::function<bool(const octomap::OcTreeKey&)>& which,
                const std::function<void(const octomap::OcTreeKey&, float)>& take);

}  // namespace hoctomap::engine
