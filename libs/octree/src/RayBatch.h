// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Lanes.h"
#include "RayTraversal.h"
#include "VoxelBits.h"

namespace hoctomap::engine {

/// What the rays of one scan have in common: the sensor, the grid, and the box that they are cut to.
struct RayFan {
  /// @param origin its key must be valid.
  /// @param bounded whether rays can leave `box`.
  RayFan(const VoxelGrid& grid, const Eigen::Vector3f& origin, const KeyBox& box, const BlockFrame& frame,
         bool bounded);

  struct Axis {
    float origin;         ///< metres
    double key;           ///< of the origin
    double to_border[2];  ///< metres from the origin to its voxel's borders, backwards and forwards
    double to_pad[2];     ///< metres from the origin to the borders of the padded box
    bool inside;          ///< the origin's key lies in the box's range
    double before[2];     ///< steps to enter that range, backwards and forwards
    double leave[2];      ///< steps to leave it
    std::int64_t local;   ///< the origin's local coordinate; may lie outside the frame
  };
  std::array<Axis, 3> axes;
  double resolution;
  double cells_per_metre;
  bool bounded;
  std::int64_t mirror_places;  ///< places of the frame's codes
};

/// Rays that are prepared, then marked, at a time: they stay in the cache.
inline constexpr std::size_t kBatch = 256;

/// The ends of a batch of rays.
struct RayEnds {
  std::size_t count = 0;
  float end[3][kBatch];  ///< metres, by axis
  /// The cells that a ray visits before so many steps along an axis may be left out. Only for an origin
  /// inside the box.
  double skip_steps[kBatch];
  Code skip_axis[kBatch];
  bool skips = false;  ///< whether any ray has such steps; else they are not read
};

/// Rays ready for marking.
///
/// Times that are not octomap's to the last bit, because a ray starts in mid-ray, differ from those by less
/// than half of `margin`: their order is the same as long as they are further apart.
struct RayBatch {
  static constexpr Code kSpecial = -1;

  double next[3][kBatch];  ///< of the first cell, by axis: see Ray
  double delta[3][kBatch];
  /// Every axis counts upwards: one that the ray goes down is mirrored (all its bits inverted), and `mirror`
  /// turns the cell back. Mirrored dilated coordinates at their axis' places, all other bits set.
  Code place[3][kBatch];
  Code mirror[kBatch];
  double margin[kBatch];  ///< metres; negative for times that are exact
  /// To be marked. 0: none. kSpecial: the ray needs the exact path, because it is not regular, or too close
  /// to a tie to be sure without exact times.
  Code cells[kBatch];
};

/// Prepares a few rays of a batch at a time.
struct Preparation {
  /// Prepares the rays from `at` on, as many as there are lanes; those beyond `ends.count` have no cells.
  void (*prepare)(const RayFan& fan, const RayEnds& ends, std::size_t at, RayBatch&);
  std::size_t lanes;
};
[[nodiscard]] Preparation choosePreparation(InstructionSet set);

}  // namespace hoctomap::engine
