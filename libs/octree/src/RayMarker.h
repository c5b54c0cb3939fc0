// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RayTraversal.h"
#include "VoxelBlocks.h"

namespace hoctomap::engine {

/// Marks the cells of regular rays, four rays at a time in lockstep: their chains of dependent operations
/// overlap, and one vector instruction serves four.
class RayMarker {
 public:
  /// @param best_instructions false: only those that every processor of the architecture has.
  RayMarker(const BlockFrame& frame, VoxelBlocks& blocks, bool best_instructions);

  /// Marks the cells of a stretch, now or by the time of `finish`.
  void add(const Ray& ray, const Stretch& stretch);

  void finish();

  static constexpr std::size_t kLanes = 4;

  using Times = double __attribute__((vector_size(kLanes * sizeof(double))));
  using Codes = Code __attribute__((vector_size(kLanes * sizeof(Code))));

  /// The state of four traversals, by axis.
  struct Lanes {
    Times next[3];
    Times delta[3];
    Codes place[3];  ///< dilated local coordinates, at their axis' places
    Codes step[3];   ///< see stepOf
  };

 private:
  const BlockFrame& frame_;
  VoxelBlocks& blocks_;
  void (*run_)(Lanes&, VoxelBlocks&, int cells);
  Lanes lanes_{};
  std::array<int, kLanes> cells_left_{};
  std::size_t used_ = 0;
};

}  // namespace hoctomap::engine
