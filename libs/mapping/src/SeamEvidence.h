// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace hoctomap {

/// A small piece of surface as a scan shows it.
struct SurfacePiece {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< m, world
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< towards the sensor; zero if too little was seen
};

/// How the surface goes from one piece to another a few centimetres away.
enum class Passage { smooth, convex, vague, concave, step };

[[nodiscard]] Passage passage(const SurfacePiece& a, const SurfacePiece& b);

/// What it says that S cut between two places, or that it did not: log-odds, in units of about 0.7, that they
/// are on two things.
[[nodiscard]] int seamEvidence(Passage passage, bool cut);

}  // namespace hoctomap
