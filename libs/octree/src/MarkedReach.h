// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "VoxelBits.h"

namespace hoctomap::engine {

/// A direction from the sensor: a face of the cube around it (3 bits) and a cell of a grid on that face, in
/// Morton order. Codes without their last 2n bits name larger cells.
using Direction = std::uint32_t;
inline constexpr unsigned kDirectionBits = 9;  ///< an axis of a face's grid
inline constexpr unsigned kDirectionCodeBits = 3 + 2 * kDirectionBits;

/// Direction of a vector that is finite and not zero.
Direction directionOf(const Eigen::Vector3f& v);

/// How far from the sensor all voxels are marked already, by direction. The beams of a scan start at the same
/// point, so that near it most of what they visit has been visited by others: they may start where that ends.
///
/// `stepsMarked` follows the cone of all rays of a direction from one layer of voxels to the next, while all
/// voxels that the cone meets are marked.
class MarkedReach {
 public:
  /// @param origin key inside the frame.
  MarkedReach(const VoxelGrid& grid, const Eigen::Vector3f& origin, const BlockFrame& frame, VoxelBits& bits);

  /// Axis that a ray of this direction runs along mostly.
  [[nodiscard]] static std::size_t axisOf(Direction direction) {
    return direction >> (2 * kDirectionBits + 1);
  }
  /// All cells that the ray visits before so many steps along that axis are marked.
  [[nodiscard]] int stepsMarked(Direction direction) { return stepsMarked(direction, kFinest); }

  /// To be called from time to time while bits are being set: looks again where the marks end.
  void refresh() { ++round_; }

 private:
  static constexpr unsigned kFinest = 7;  ///< bits an axis: cones of 2^-6, for a camera about 8 pixels wide
  static constexpr unsigned kCoarsest = 5;

  struct Reach {
    std::uint16_t round = 0;
    std::uint16_t steps = 0;
  };
  struct Range {
    int first;
    int last;
  };
  struct Cone;

  [[nodiscard]] int stepsMarked(Direction direction, unsigned bits);
  [[nodiscard]] int follow(const Cone& cone, int steps) const;
  [[nodiscard]] bool allMarked(const Cone& cone, const Range& steps, double near, double far) const;
  [[nodiscard]] bool allMarked(const std::array<Range, 3>& cells) const;

  std::array<double, 3> origin_{};  ///< in voxels, from the corner of the frame
  Key origin_key_{};                ///< local
  int edge_;                        ///< of the frame, in voxels
  VoxelBits& bits_;
  std::uint16_t round_ = 1;
  std::array<std::vector<Reach>, kFinest - kCoarsest + 1> reach_;  ///< by direction
};

}  // namespace hoctomap::engine
