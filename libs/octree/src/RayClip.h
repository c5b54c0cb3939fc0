// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "RayTraversal.h"

namespace hoctomap::engine {

/// Equals `count` times `t += delta`, to the last bit, in a few steps a power of two.
/// @param delta positive and finite.
double addRepeatedly(double t, double delta, int count);

/// The part of a regular ray inside `box`: the cells that octomap's loop would visit there, and the crossing
/// times that it would have on entering, to the last bit. None if it visits no cell of the box.
std::optional<Stretch> clipRegularRay(const Ray& ray, const KeyBox& box);

/// A quick test before anything exact: false only if no cell of the beam can lie in the box.
class BoxFilter {
 public:
  BoxFilter(const VoxelGrid& grid, const Eigen::Vector3f& origin, const KeyBox& box);

  [[nodiscard]] bool mayMeet(const Eigen::Vector3f& end) const;

 private:
  std::array<double, 3> origin_;
  std::array<double, 3> to_min_;  ///< from the origin to the corners of the padded box
  std::array<double, 3> to_max_;
};

}  // namespace hoctomap::engine
