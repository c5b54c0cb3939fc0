// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "Lanes.h"
#include "VoxelBits.h"

namespace hoctomap::engine {

/// The state of four traversals, by axis. Every axis counts upwards: one that the ray goes down is mirrored
/// (all its bits inverted), and `mirror` turns the cell back.
struct Traversals {
  Doubles next[3];
  Doubles delta[3];
  Codes place[3];  ///< mirrored dilated coordinates at their axis' places, all other bits set
  Codes mirror;    ///< the axes' places that are mirrored
};

/// Marks the cells of regular rays, four rays at a time in lockstep: their chains of dependent operations
/// overlap, and one vector instruction serves four.
class RayMarker {
 public:
  /// @param best_instructions false: only those that every processor of the architecture has.
  RayMarker(VoxelBits& bits, bool best_instructions);

  /// Marks `cells` (at least 1) cells of the traversal `from[lane]`, now or by the time of `finish`.
  void add(const Traversals& from, std::size_t lane, int cells);

  void finish();

 private:
  VoxelBits& bits_;
  void (*run_)(Traversals&, BlockBits*, std::uint8_t*, int cells);
  Traversals lanes_{};
  std::array<int, kLanes> cells_left_{};
  std::size_t used_ = 0;
};

}  // namespace hoctomap::engine
