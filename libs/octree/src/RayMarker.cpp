// SPDX-License-Identifier: BSD-3-Clause
#include "RayMarker.h"

#include <algorithm>

namespace hoctomap::engine {

namespace {

using Lanes = RayMarker::Lanes;
using Times = RayMarker::Times;
using Codes = RayMarker::Codes;

/// `value` where the mask is set, else zero.
[[gnu::always_inline]] inline void addWhere(Times& sum, const Times& value, const Codes& mask) {
  sum += reinterpret_cast<Times>(reinterpret_cast<Codes>(value) & mask);
}

/// The cells where the lanes stand. (By reference: how vectors are returned depends on the instruction set.)
[[gnu::always_inline]] inline void cellsOf(const Lanes& l, Codes& cells) {
  cells = l.place[0] | l.place[1] | l.place[2];
}

/// Takes each lane to its next cell. No branch depends on the rays: the earliest crossing (octomap's order:
/// see nextAxis) is found by masks, and the other axes add zero, which changes no time and no place.
[[gnu::always_inline]] inline void step(Lanes& l) {
  const Codes x_before_y = l.next[0] < l.next[1];
  const Codes x_before_z = l.next[0] < l.next[2];
  const Codes y_before_z = l.next[1] < l.next[2];
  const Codes x = x_before_y & x_before_z;
  const Codes y = ~x_before_y & y_before_z;
  const Codes z = ~(x | y);
  addWhere(l.next[0], l.delta[0], x);
  addWhere(l.next[1], l.delta[1], y);
  addWhere(l.next[2], l.delta[2], z);
  l.place[0] = (l.place[0] + (l.step[0] & x)) & kAxisMask[0];
  l.place[1] = (l.place[1] + (l.step[1] & y)) & kAxisMask[1];
  l.place[2] = (l.place[2] + (l.step[2] & z)) & kAxisMask[2];
}

/// Marks the next `count` cells of each lane, in blocks that need not exist.
/// @param cells in: where the lanes stand; out: the last cells marked.
[[gnu::always_inline]] inline void markCells(Lanes& lanes, VoxelBlocks::Table table, int count,
                                             Codes& cells) {
  Lanes l = lanes;
  for (; count > 0; --count) {
    cellsOf(l, cells);
#pragma GCC unroll 4
    for (std::size_t lane = 0; lane < RayMarker::kLanes; ++lane) {
      setBit(table[cells[lane] >> kBlockCodeBits], cells[lane]);
    }
    step(l);
  }
  lanes = l;
}

/// Creates the blocks that the next `count` cells lie in. True if any was missing.
bool ensureBlocks(const Lanes& before, VoxelBlocks& blocks, int count) {
  Lanes lanes = before;
  bool missing = false;
  for (; count > 0; --count) {
    Codes cells;
    cellsOf(lanes, cells);
    for (std::size_t lane = 0; lane < RayMarker::kLanes; ++lane) {
      missing |= blocks.ensure(cells[lane] >> kBlockCodeBits);
    }
    step(lanes);
  }
  return missing;
}

/// True if all blocks exist that a ray could meet between these two, which differ by at most one step an
/// axis.
[[gnu::always_inline]] inline bool exist(const VoxelBlocks& blocks, Code first, Code last) {
  if (blocks.find(first) == nullptr) return false;
  if (first == last) return true;
  for (unsigned choice = 1; choice < 8; ++choice) {  // each coordinate from the one or the other
    const Code mask = ((choice & 1U) != 0 ? kAxisMask[0] : 0) | ((choice & 2U) != 0 ? kAxisMask[1] : 0) |
                      ((choice & 4U) != 0 ? kAxisMask[2] : 0);
    if (blocks.find((last & mask) | (first & ~mask)) == nullptr) return false;
  }
  return true;
}

/// The inner loop makes no call and takes every block for granted: what it marks in missing ones is lost. A
/// chunk that met one is done again; marking twice does no harm. There are few blocks, so that is rare.
[[gnu::always_inline]] inline void runLanes(Lanes& lanes, VoxelBlocks& blocks, int cells) {
  constexpr int kChunk = 64;  // the edge of a block: along an axis a chunk crosses one border at most
  while (cells > 0) {
    const int count = std::min(cells, kChunk);
    const Lanes before = lanes;
    Codes first;
    cellsOf(lanes, first);
    Codes last = first;
    markCells(lanes, blocks.table(), count, last);
    bool covered = true;
    for (std::size_t lane = 0; lane < RayMarker::kLanes; ++lane) {
      covered = covered && exist(blocks, first[lane] >> kBlockCodeBits, last[lane] >> kBlockCodeBits);
    }
    if (!covered && ensureBlocks(before, blocks, count)) {
      lanes = before;
      markCells(lanes, blocks.table(), count, last);
    }
    cells -= count;
  }
}

void runBaseline(Lanes& lanes, VoxelBlocks& blocks, int cells) {
  runLanes(lanes, blocks, cells);
}

#if defined(__x86_64__)
[[gnu::target("avx2,bmi2")]] void runAvx2(Lanes& lanes, VoxelBlocks& blocks, int cells) {
  runLanes(lanes, blocks, cells);
}
bool hasAvx2() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2");
}
#endif

auto chooseRun(bool best_instructions) {
#if defined(__x86_64__)
  if (best_instructions && hasAvx2()) return &runAvx2;
#endif
  static_cast<void>(best_instructions);
  return &runBaseline;
}

}  // namespace

RayMarker::RayMarker(const BlockFrame& frame, VoxelBlocks& blocks, bool best_instructions)
    : frame_(frame), blocks_(blocks), run_(chooseRun(best_instructions)) {}

void RayMarker::add(const Ray& ray, const Stretch& stretch) {
  std::size_t lane = 0;
  while (cells_left_[lane] > 0) ++lane;
  cells_left_[lane] = stretch.cells;
  for (std::size_t i = 0; i < 3; ++i) {
    const int key = ray.origin[i] + ray.step[i] * stretch.start.taken[i];
    lanes_.next[i][lane] = stretch.start.next[i];
    lanes_.delta[i][lane] = ray.delta[i];
    lanes_.place[i][lane] = dilate(key - frame_.corner()[i]) << i;
    lanes_.step[i][lane] = stepOf(i, ray.step[i]);
  }
  if (++used_ < kLanes) return;
  const int cells = *std::min_element(cells_left_.begin(), cells_left_.end());
  run_(lanes_, blocks_, cells);
  for (int& left : cells_left_) {
    left -= cells;
    if (left == 0) --used_;
  }
}

void RayMarker::finish() {
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    if (cells_left_[lane] == 0) continue;
    // All four lanes take the same ray: marking a voxel again does no harm.
    Lanes same = lanes_;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t other = 0; other < kLanes; ++other) {
        same.next[i][other] = lanes_.next[i][lane];
        same.delta[i][other] = lanes_.delta[i][lane];
        same.place[i][other] = lanes_.place[i][lane];
        same.step[i][other] = lanes_.step[i][lane];
      }
    }
    run_(same, blocks_, cells_left_[lane]);
    cells_left_[lane] = 0;
  }
  used_ = 0;
}

}  // namespace hoctomap::engine
