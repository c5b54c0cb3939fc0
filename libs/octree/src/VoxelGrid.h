// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace hoctomap::engine {

/// Key of a voxel: as octomap::OcTreeKey, in int for arithmetic without surprises.
using Key = std::array<int, 3>;

inline constexpr int kKeyOffset = 32768;  ///< the key of coordinate 0 (OctoMap's tree_max_val)
inline constexpr int kMaxKey = 2 * kKeyOffset - 1;

/// Inclusive range of keys. Empty if some min > max.
struct KeyBox {
  Key min{0, 0, 0};
  Key max{kMaxKey, kMaxKey, kMaxKey};

  [[nodiscard]] bool empty() const { return min[0] > max[0] || min[1] > max[1] || min[2] > max[2]; }
  [[nodiscard]] bool contains(const Key& k) const {
    return k[0] >= min[0] && k[0] <= max[0] && k[1] >= min[1] && k[1] <= max[1] && k[2] >= min[2] &&
           k[2] <= max[2];
  }
  [[nodiscard]] KeyBox intersection(const KeyBox& other) const {
    KeyBox both;
    for (std::size_t i = 0; i < 3; ++i) {
      both.min[i] = std::max(min[i], other.min[i]);
      both.max[i] = std::min(max[i], other.max[i]);
    }
    return both;
  }
  /// The smallest box around two that are not empty.
  [[nodiscard]] KeyBox merged(const KeyBox& other) const {
    KeyBox both;
    for (std::size_t i = 0; i < 3; ++i) {
      both.min[i] = std::min(min[i], other.min[i]);
      both.max[i] = std::max(max[i], other.max[i]);
    }
    return both;
  }
};

inline constexpr KeyBox kAllKeys;
inline constexpr KeyBox kNoKeys{{1, 1, 1}, {0, 0, 0}};

/// Keys and coordinates along one axis, with the arithmetic of octomap::OcTree to the last bit.
class VoxelGrid {
 public:
  explicit VoxelGrid(double resolution)
      : resolution_(resolution),
        cells_per_metre_(1.0 / resolution),
        half_cell_(static_cast<float>(resolution * 0.5)) {}

  [[nodiscard]] double resolution() const { return resolution_; }
  [[nodiscard]] double cellsPerMetre() const { return cells_per_metre_; }

  /// As coordToKeyChecked; -1 instead of false (also for NaN).
  [[nodiscard]] int checkedKey(double coordinate) const {
    const double cell = cells_per_metre_ * coordinate;
    if (!(cell >= -kKeyOffset && cell < kKeyOffset)) return -1;
    const int truncated = static_cast<int>(cell);
    return truncated - (truncated > cell ? 1 : 0) + kKeyOffset;  // floor, without a call
  }

  /// As coordToKeyChecked of a point.
  [[nodiscard]] bool checkedKey(const Eigen::Vector3f& p, Key& key) const {
    key = {checkedKey(p.x()), checkedKey(p.y()), checkedKey(p.z())};
    return key[0] >= 0 && key[1] >= 0 && key[2] >= 0;
  }

  /// A coordinate beyond the key range means the nearest key.
  [[nodiscard]] int clampedKey(double coordinate) const {
    const double cell = std::floor(cells_per_metre_ * coordinate) + kKeyOffset;
    return static_cast<int>(std::clamp(cell, 0.0, static_cast<double>(kMaxKey)));
  }

  /// As keyToCoord: centre of the voxel.
  [[nodiscard]] double center(int key) const {
    return (static_cast<double>(key - kKeyOffset) + 0.5) * resolution_;
  }

  /// As in computeRayKeys: the border of the voxel towards `step` (-1 or 1).
  [[nodiscard]] double border(int key, int step) const {
    return center(key) + static_cast<double>(static_cast<float>(step) * half_cell_);
  }

  /// Keys of the corners, clamped to the key range; all keys if there are no bounds.
  [[nodiscard]] KeyBox keyBox(const std::optional<Eigen::AlignedBox3d>& bounds) const {
    KeyBox box;
    if (!bounds) return box;
    for (std::size_t i = 0; i < 3; ++i) {
      box.min[i] = clampedKey(bounds->min()[static_cast<Eigen::Index>(i)]);
      box.max[i] = clampedKey(bounds->max()[static_cast<Eigen::Index>(i)]);
    }
    return box;
  }

 private:
  double resolution_;
  double cells_per_metre_;
  // Rounded to single precision, as octomap does. Kept as a member because GCC 12 drops the rounding (double
  // to float and back) when it vectorises an expression that does it in place.
  float half_cell_;
};

}  // namespace hoctomap::engine
