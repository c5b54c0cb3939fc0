// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hoctomap/octree/NodeMap.h"

namespace hoctomap {

/// The surface of the occupied voxels of a map, in its frame: faces between two occupied voxels left out,
/// faces in one plane joined to rectangles, counter-clockwise seen from outside.
struct SurfaceMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::uint32_t> triangles;  ///< three indices each
};

/// Greedy meshing: a rectangle grows along one axis, then along the other, as far as faces are there.
[[nodiscard]] SurfaceMesh greedyMesh(const NodeMap& map);

}  // namespace hoctomap
