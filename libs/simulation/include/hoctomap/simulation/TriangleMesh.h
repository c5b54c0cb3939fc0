// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

namespace hoctomap {

/// The surface of a solid, metres, in the solid's own frame.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  /// Adds another surface, moved by `this_T_other`.
  void append(const TriangleMesh& other, const Eigen::Isometry3d& this_T_other);
};

/// Where a surface is: what truth files say of an object.
struct SurfaceExtent {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< of the surface, weighted by area
  Eigen::AlignedBox3d box;                             ///< around the vertices
};

/// Extent of the surface moved by `world_T_mesh`. The box is empty if there are no vertices.
[[nodiscard]] SurfaceExtent surfaceExtent(const TriangleMesh& mesh, const Eigen::Isometry3d& world_T_mesh);

/// Square metres.
[[nodiscard]] double surfaceArea(const TriangleMesh& mesh);

}  // namespace hoctomap
