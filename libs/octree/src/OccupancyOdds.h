// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

namespace hoctomap::engine {

/// The tree's sensor model: what a miss and a hit make of a voxel's log-odds.
class OccupancyOdds {
 public:
  explicit OccupancyOdds(const octomap::OcTree& tree)
      : miss_(tree.getProbMissLog()),
        hit_(tree.getProbHitLog()),
        min_(tree.getClampingThresMinLog()),
        max_(tree.getClampingThresMaxLog()) {}

  /// Added by a miss, by a hit, and the limits of the sum.
  [[nodiscard]] float miss() const { return miss_; }
  [[nodiscard]] float hit() const { return hit_; }
  [[nodiscard]] float min() const { return min_; }
  [[nodiscard]] float max() const { return max_; }

  [[nodiscard]] float created(bool hit) const { return add(0.0F, hit); }
  /// As octomap's updateNode of an existing voxel, early abort included.
  [[nodiscard]] float updated(float value, bool hit) const {
    return keeps(value, hit) ? value : add(value, hit);
  }
  /// True if octomap would not touch a voxel of this value.
  [[nodiscard]] bool keeps(float value, bool hit) const {
    const float update = hit ? hit_ : miss_;
    return (update >= 0.0F && value >= max_) || (update <= 0.0F && value <= min_);
  }

 private:
  [[nodiscard]] float add(float value, bool hit) const {
    const float sum = value + (hit ? hit_ : miss_);
    if (sum < min_) return min_;
    return sum > max_ ? max_ : sum;
  }

  float miss_;
  float hit_;
  float min_;
  float max_;
};

}  // namespace hoctomap::engine
