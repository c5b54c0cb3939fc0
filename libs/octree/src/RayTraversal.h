// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "VoxelGrid.h"

namespace hoctomap::engine {

/// A beam prepared for traversal, with the arithmetic of octomap's computeRayKeys (Amanatides and Woo).
///
/// Axis i crosses its next voxel border at the time `next[i]` and every `delta[i]` after that. The traversal
/// takes one crossing after the other, the earliest first; of equal ones the higher axis.
struct Ray {
  Key origin;                   ///< first voxel, free
  Key end;                      ///< voxel of the endpoint, not part of the free cells
  std::array<int, 3> step;      ///< -1, 0, 1
  std::array<int, 3> steps;     ///< |end - origin|
  std::array<double, 3> next;   ///< octomap's tMax at the origin
  std::array<double, 3> delta;  ///< octomap's tDelta
  float length;                 ///< metres

  /// Free cells of a regular ray, the origin included.
  [[nodiscard]] int cells() const { return steps[0] + steps[1] + steps[2]; }
};

/// Where a traversal stands: after so many steps an axis, with the crossings that come next.
struct Position {
  std::array<int, 3> taken;
  std::array<double, 3> next;
};

/// A part of a regular ray: `cells` free cells from `start` on, without any test for the end.
struct Stretch {
  Position start;
  int cells;
};

/// True if the crossing (t, axis) comes before (other_t, other_axis) in octomap's order.
inline bool crossesBefore(double t, std::size_t axis, double other_t, std::size_t other_axis) {
  return t < other_t || (t == other_t && axis > other_axis);
}

/// Axis of the earliest of three crossings, in octomap's order.
inline std::size_t nextAxis(const std::array<double, 3>& next) {
  if (next[0] < next[1]) return next[0] < next[2] ? 0 : 2;
  return next[1] < next[2] ? 1 : 2;
}

/// Makes the rays of one scan: what depends on the origin only is computed once.
class RayCaster {
 public:
  /// @param origin sensor position; if it lies beyond the key range there are no rays.
  RayCaster(const VoxelGrid& grid, const Eigen::Vector3f& origin);

  [[nodiscard]] bool originValid() const { return valid_; }
  [[nodiscard]] const Key& originKey() const { return key_; }

  /// The ray to `end`, whose key is `end_key`.
  [[nodiscard]] Ray prepare(const Eigen::Vector3f& end, const Key& end_key) const;

 private:
  Eigen::Vector3f origin_;
  Key key_{};
  bool valid_;
  double resolution_;
  std::array<std::array<double, 2>, 3> to_border_{};  ///< per axis, backwards and forwards
};

/// True if it is certain that octomap's loop reaches the end key, and by the shortest way: then the free
/// cells are the origin and the `cells() - 1` next ones, and no termination test is needed.
bool isRegular(const Ray& ray);

/// The whole of a regular ray.
inline Stretch wholeRay(const Ray& ray) {
  return {{{0, 0, 0}, ray.next}, ray.cells()};
}

/// The cells of a stretch of a regular ray: calls `visit(key)` for each.
template <class Visit>
void walkStretch(const Ray& ray, const Stretch& stretch, Visit&& visit) {
  Key key = ray.origin;
  for (std::size_t i = 0; i < 3; ++i) key[i] += ray.step[i] * stretch.start.taken[i];
  std::array<double, 3> next = stretch.start.next;
  for (int cell = 0; cell < stretch.cells; ++cell) {
    visit(key);
    const std::size_t axis = nextAxis(next);
    key[axis] += ray.step[axis];
    next[axis] += ray.delta[axis];
  }
}

/// octomap's own loop, for the few rays that are not regular: calls `visit(key)` for each free cell.
/// Keys wrap at the end of the key range as octomap's do.
template <class Visit>
void walkAsOctomap(const Ray& ray, Visit&& visit) {
  // No meaningful ray has more cells; octomap would write beyond its buffer of 100,000 keys.
  constexpr int kMaxCells = 3 * (kMaxKey + 1);
  if (ray.origin == ray.end) return;
  Key key = ray.origin;
  std::array<double, 3> next = ray.next;
  visit(key);
  for (int cell = 1; cell < kMaxCells; ++cell) {
    const std::size_t axis = nextAxis(next);
    key[axis] = (key[axis] + ray.step[axis]) & kMaxKey;
    next[axis] += ray.delta[axis];
    if (key == ray.end) return;
    if (std::min({next[0], next[1], next[2]}) > static_cast<double>(ray.length)) return;
    visit(key);
  }
}

}  // namespace hoctomap::engine
