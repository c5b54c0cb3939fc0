// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "SurfacePatches.h"

namespace hoctomap {

/// Where two patches meet.
struct PatchBorder {
  std::int32_t a = 0;
  std::int32_t b = 0;     ///< a < b
  double length = 0.0;    ///< pixel pairs across the border
  double jumps = 0.0;     ///< of them those at which the surface steps
  double depth = 0.0;     ///< m, of all these steps together
  double in_front = 0.0;  ///< of these, those at which a is nearer, less those at which b is
  double crease = 0.0;    ///< degrees between the normals, positive where the surface is concave
  double distance = 0.0;  ///< m between the centres
  double evidence = 0.0;  ///< degrees, that a and b are two things: concave creases and steps are

  [[nodiscard]] bool isContact() const { return 2.0 * jumps <= length; }
  [[nodiscard]] std::int32_t other(std::int32_t patch) const { return patch == a ? b : a; }
  /// rad/m, positive where concave.
  [[nodiscard]] double curvature() const;
};

/// The patches as nodes, their borders as edges.
struct PatchGraph {
  std::vector<PatchBorder> borders;
  std::vector<std::vector<std::uint32_t>> borders_of;  ///< of every patch
  std::vector<double> perimeter;                       ///< pixel pairs, also towards what is no object
  std::vector<double> area;                            ///< pixels
  std::vector<Eigen::Vector3d> centers;                ///< m, camera frame
  std::vector<Eigen::Vector3d> normals;                ///< towards the camera
};

[[nodiscard]] PatchGraph patchGraph(const InverseDepthImage& image, const SurfacePatches& patches,
                                    const PatchScales& scales);

}  // namespace hoctomap
