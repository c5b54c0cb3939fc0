// SPDX-License-Identifier: BSD-3-Clause
#include "RayMarker.h"

#include <algorithm>

namespace hoctomap::engine {

namespace {

/// Adds `value` where the mask is set, else zero.
[[gnu::always_inline]] inline void addWhere(Doubles& sum, const Doubles& value, const Codes& mask) {
  sum += reinterpret_cast<Doubles>(reinterpret_cast<Codes>(value) & mask);
}

/// The cells where the lanes stand. (By reference: how vectors are returned depends on the instruction set.)
[[gnu::always_inline]] inline void cellsOf(const Traversals& l, Codes& cells) {
  cells = (l.place[0] & l.place[1] & l.place[2]) ^ l.mirror;
}

/// Takes each lane to its next cell. No branch depends on the rays: the earliest crossing (octomap's order:
/// see nextAxis) is found by masks, and the other axes add zero, which changes no time and no place.
[[gnu::always_inline]] inline void step(Traversals& l) {
  const Codes x_before_y = l.next[0] < l.next[1];
  const Codes x_before_z = l.next[0] < l.next[2];
  const Codes y_before_z = l.next[1] < l.next[2];
  const Codes x = x_before_y & x_before_z;
  const Codes y = ~x_before_y & y_before_z;
  const Codes z = ~(x | y);
  addWhere(l.next[0], l.delta[0], x);
  addWhere(l.next[1], l.delta[1], y);
  addWhere(l.next[2], l.delta[2], z);
  // A mask is -1 where set: this adds 1, and the carry runs over the other axes' bits, which are all set.
  l.place[0] = (l.place[0] - x) | ~kAxisPlaces[0];
  l.place[1] = (l.place[1] - y) | ~kAxisPlaces[1];
  l.place[2] = (l.place[2] - z) | ~kAxisPlaces[2];
}

/// Flags the pages that a ray could meet between two cells that differ by at most one page an axis.
[[gnu::always_inline]] inline void flagPages(std::uint8_t* pages, Code first, Code last) {
  first >>= kPageCodeBits;
  last >>= kPageCodeBits;
  pages[first] = 1;
  if (first == last) return;
  for (unsigned choice = 1; choice < 8; ++choice) {  // each coordinate from the one or the other
    const Code mask = ((choice & 1U) != 0 ? kAxisMask[0] : 0) | ((choice & 2U) != 0 ? kAxisMask[1] : 0) |
                      ((choice & 4U) != 0 ? kAxisMask[2] : 0);
    pages[(last & mask) | (first & ~mask)] = 1;
  }
}

[[gnu::always_inline]] inline void runLanes(Traversals& lanes, BlockBits* words, std::uint8_t* pages,
                                            int cells) {
  constexpr int kChunk = 32;  // the edge of a page: along an axis a chunk crosses one border at most
  Traversals l = lanes;
  while (cells > 0) {
    const int count = std::min(cells, kChunk);
    Codes first;
    cellsOf(l, first);
    Codes last = first;
    for (int i = 0; i < count; ++i) {
      cellsOf(l, last);
#pragma GCC unroll 4
      for (std::size_t lane = 0; lane < kLanes; ++lane) setBit(words, last[lane]);
      step(l);
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) flagPages(pages, first[lane], last[lane]);
    cells -= count;
  }
  lanes = l;
}

void runBaseline(Traversals& lanes, BlockBits* words, std::uint8_t* pages, int cells) {
  runLanes(lanes, words, pages, cells);
}

HOCTOMAP_TARGET_AVX2 void runAvx2(Traversals& lanes, BlockBits* words, std::uint8_t* pages, int cells) {
  runLanes(lanes, words, pages, cells);
}

}  // namespace

RayMarker::RayMarker(VoxelBits& bits, bool best_instructions)
    : bits_(bits), run_(best_instructions && hasAvx2() ? &runAvx2 : &runBaseline) {}

void RayMarker::add(const Traversals& from, std::size_t from_lane, int cells) {
  std::size_t lane = 0;
  while (cells_left_[lane] > 0) ++lane;
  cells_left_[lane] = cells;
  for (std::size_t i = 0; i < 3; ++i) {
    lanes_.next[i][lane] = from.next[i][from_lane];
    lanes_.delta[i][lane] = from.delta[i][from_lane];
    lanes_.place[i][lane] = from.place[i][from_lane];
  }
  lanes_.mirror[lane] = from.mirror[from_lane];
  if (++used_ < kLanes) return;
  const int shortest = *std::min_element(cells_left_.begin(), cells_left_.end());
  run_(lanes_, bits_.words(), bits_.pages(), shortest);
  for (int& left : cells_left_) {
    left -= shortest;
    if (left == 0) --used_;
  }
}

void RayMarker::finish() {
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    if (cells_left_[lane] == 0) continue;
    // All four lanes take the same ray: marking a voxel again does no harm.
    Traversals same = lanes_;
    for (std::size_t other = 0; other < kLanes; ++other) {
      for (std::size_t i = 0; i < 3; ++i) {
        same.next[i][other] = lanes_.next[i][lane];
        same.delta[i][other] = lanes_.delta[i][lane];
        same.place[i][other] = lanes_.place[i][lane];
      }
      same.mirror[other] = lanes_.mirror[lane];
    }
    run_(same, bits_.words(), bits_.pages(), cells_left_[lane]);
    cells_left_[lane] = 0;
  }
  used_ = 0;
}

}  // namespace hoctomap::engine
