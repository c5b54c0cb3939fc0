// SPDX-License-Identifier: BSD-3-Clause
#include "RayTraversal.h"

#include <cmath>
#include <cstdlib>

namespace hoctomap::engine {

RayCaster::RayCaster(const VoxelGrid& grid, const Eigen::Vector3f& origin)
    : origin_(origin), valid_(grid.checkedKey(origin, key_)), resolution_(grid.resolution()) {
  if (!valid_) return;
  for (std::size_t i = 0; i < 3; ++i) {
    const double coordinate = origin_[static_cast<Eigen::Index>(i)];
    to_border_[i] = {grid.border(key_[i], -1) - coordinate, grid.border(key_[i], 1) - coordinate};
  }
}

Ray RayCaster::prepare(const Eigen::Vector3f& end, const Key& end_key) const {
  Ray ray;
  ray.origin = key_;
  ray.end = end_key;
  // Written out: Eigen might sum or divide in another order, and every bit counts.
  const float dx = end.x() - origin_.x();
  const float dy = end.y() - origin_.y();
  const float dz = end.z() - origin_.z();
  ray.length = static_cast<float>(std::sqrt(static_cast<double>(dx * dx + dy * dy + dz * dz)));
  const std::array<float, 3> direction{dx / ray.length, dy / ray.length, dz / ray.length};
  for (std::size_t i = 0; i < 3; ++i) {
    const float d = direction[i];
    ray.step[i] = d > 0.0F ? 1 : d < 0.0F ? -1 : 0;
    ray.steps[i] = std::abs(end_key[i] - key_[i]);
    if (ray.step[i] == 0) {
      ray.next[i] = ray.delta[i] = std::numeric_limits<double>::max();
    } else {
      ray.next[i] = to_border_[i][d > 0.0F ? 1 : 0] / static_cast<double>(d);
      ray.delta[i] = resolution_ / static_cast<double>(std::fabs(d));
    }
  }
  return ray;
}

bool isRegular(const Ray& ray) {
  // octomap adds delta again and again; n * delta differs from that by less than 1e-11 of the time (65535
  // additions, each rounded to 53 bits), so a gap of 1e-10 decides.
  double last = 0.0;                                        // the last crossing that leads to the end key
  double beyond = std::numeric_limits<double>::infinity();  // the first crossing that would lead past it
  for (std::size_t i = 0; i < 3; ++i) {
    const int distance = ray.end[i] - ray.origin[i];
    if (distance != ray.step[i] * ray.steps[i]) return false;
    if (ray.steps[i] == 0) {
      beyond = std::min(beyond, ray.next[i]);
      continue;
    }
    const double crossing = ray.next[i] + (ray.steps[i] - 1) * ray.delta[i];
    last = std::max(last, crossing);
    beyond = std::min(beyond, crossing + ray.delta[i]);
  }
  const double certain = last + 1e-10 * (1.0 + last);
  return certain < beyond && certain < static_cast<double>(ray.length);
}

}  // namespace hoctomap::engine
