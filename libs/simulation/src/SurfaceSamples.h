// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "hoctomap/simulation/TriangleMesh.h"

namespace hoctomap {

struct SurfaceSample {
  Eigen::Vector3d point;
  Eigen::Vector3d normal;  ///< of unit length, inside or outside
};

/// Points spread evenly over a surface moved by `world_T_mesh`: one for every spacing^2 of its area.
[[nodiscard]] std::vector<SurfaceSample> sampleSurface(const TriangleMesh& mesh,
                                                       const Eigen::Isometry3d& world_T_mesh, double spacing);

}  // namespace hoctomap
