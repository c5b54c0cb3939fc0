// SPDX-License-Identifier: BSD-3-Clause
#include "RayBatch.h"

#include "RayPreparation.h"
#include "WideRayBatch.h"

namespace hoctomap::engine {

namespace {

void prepareBaseline(const RayFan& fan, const RayEnds& ends, std::size_t at, RayBatch& batch) {
  prepare<Lanes<kNarrowLanes>>(fan, ends, at, batch);
}

HOCTOMAP_TARGET_AVX2 void prepareAvx2(const RayFan& fan, const RayEnds& ends, std::size_t at,
                                      RayBatch& batch) {
  prepare<Lanes<kNarrowLanes>>(fan, ends, at, batch);
}

}  // namespace

RayFan::RayFan(const VoxelGrid& grid, const Eigen::Vector3f& origin, const KeyBox& box,
               const BlockFrame& frame, bool is_bounded)
    : axes{},
      resolution(grid.resolution()),
      cells_per_metre(grid.cellsPerMetre()),
      bounded(is_bounded),
      mirror_places((Code{1} << (3 * frame.levels() + kBlockCodeBits)) - 1) {
  // A cell that octomap visits lies within one voxel of the beam: its rounding is a hundredth of a voxel.
  constexpr int kPadding = 2;
  for (std::size_t i = 0; i < 3; ++i) {
    Axis& axis = axes[i];
    axis.origin = origin[static_cast<Eigen::Index>(i)];
    const double at = axis.origin;
    const int key = grid.checkedKey(at);
    axis.key = key;
    axis.to_border[0] = grid.border(key, -1) - at;
    axis.to_border[1] = grid.border(key, 1) - at;
    axis.to_pad[0] = grid.center(box.min[i] - kPadding) - at;
    axis.to_pad[1] = grid.center(box.max[i] + kPadding) - at;
    axis.inside = key >= box.min[i] && key <= box.max[i];
    axis.before[0] = key - box.max[i];
    axis.before[1] = box.min[i] - key;
    axis.leave[0] = 1 + key - box.min[i];
    axis.leave[1] = 1 + box.max[i] - key;
    axis.local = key - frame.corner()[i];
  }
}

Preparation choosePreparation(InstructionSet set) {
  switch (set) {
    case InstructionSet::baseline:
      break;
    case InstructionSet::avx2:
      return {&prepareAvx2, kNarrowLanes};
    case InstructionSet::avx512:
      return {&prepareWide, kWidePreparation};
  }
  return {&prepareBaseline, kNarrowLanes};
}

}  // namespace hoctomap::engine
