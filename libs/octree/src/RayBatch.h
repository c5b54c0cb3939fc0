// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "RayMarker.h"
#include "RayTraversal.h"

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

/// Four rays made ready for the marker.
struct RayBatch {
  enum class State : std::uint8_t {
    none,     ///< no cell to mark
    ready,    ///< `cells` cells from `start`
    special,  ///< needs the exact path: not regular, or too close to a tie to be sure without exact times
  };
  Traversals start;
  std::array<State, kLanes> state;
  std::array<int, kLanes> cells;
};

/// Sets lane 0 of `start` to a stretch found by the exact path.
void placeRay(const RayFan& fan, const Ray& ray, const Stretch& stretch, Traversals& start);

/// Four endpoints, and what needs no walk.
struct Ends {
  std::array<Eigen::Vector3f, kLanes> points;
  std::size_t count = 0;
  /// The cells that a ray visits before so many steps along an axis may be left out. Only for an origin
  /// inside the box.
  std::array<int, kLanes> skip_steps;
  std::array<std::size_t, kLanes> skip_axis;
  bool skips = false;  ///< whether any ray has such steps; else they are not set
};

/// Prepares the rays to the first `ends.count` (1 to 4) endpoints.
using PrepareRays = void (*)(const RayFan&, const Ends& ends, RayBatch&);
[[nodiscard]] PrepareRays choosePrepareRays(bool best_instructions);

}  // namespace hoctomap::engine
