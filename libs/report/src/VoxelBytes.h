// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "hoctomap/octree/NodeMap.h"

namespace hoctomap {

/// The octree of a node for the page, little endian: the number of its inner nodes (4 bytes); for each, depth
/// first, 2 bytes with two bits a child from the lowest up (0 unknown, 1 free leaf, 2 occupied leaf, 3 inner
/// node, which follows); then for each occupied leaf in the same order 1 byte, its probability times 255.
/// All leaves are at most 16 levels below the root. Coarse leaves stand for all the voxels they cover.
///
/// Occupied leaves are all there. Free space, most of an octree, is as fine as it is shown, in at most 96
/// cells along its longest side: a cell, a power of two of voxels wide, is free if part of it is and nothing
/// in it is occupied.
[[nodiscard]] std::string voxelBytes(const NodeMap& map);

}  // namespace hoctomap
