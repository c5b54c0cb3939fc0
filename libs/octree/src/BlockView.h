// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>

#include "VoxelBits.h"

namespace hoctomap::engine {

/// The marks of one block.
struct BlockMarks {
  Code tree_code;  ///< of the block in the whole tree
  const BlockBits* free;
  const BlockBits* occupied;
  std::uint64_t free_pages;  ///< a byte a page (an octant of the block): 0 if it has no marks
  std::uint64_t occupied_pages;
};

/// What a scan says of the voxels of one octree node: which of the two updates some of them, or all, receive.
struct Coverage {
  bool any_free;
  bool all_free;
  bool any_occupied;
  bool all_occupied;

  [[nodiscard]] bool any() const { return any_free || any_occupied; }
};

/// The marks of a block with occupied winning over free, and a summary that tells the coverage of every node
/// in it.
class BlockView {
 public:
  explicit BlockView(const BlockMarks& marks);

  /// Coverage of the node `level` levels above the voxels (2 to 6) whose first voxel is at `offset` in Morton
  /// order.
  template <unsigned level>
  [[nodiscard]] Coverage coverage(unsigned offset) const;

  /// Free and occupied voxels of a node of 2^3 voxels.
  [[nodiscard]] unsigned freeCube(unsigned offset) const { return cube(free(offset / 64), offset); }
  [[nodiscard]] unsigned occupiedCube(unsigned offset) const { return cube(occupied(offset / 64), offset); }

 private:
  static constexpr std::size_t kBricks = kBlockWords / 8;  ///< nodes of 8^3 voxels
  using BrickSet = std::array<BlockBits, kBricks / 64>;    ///< one bit a brick, in Morton order

  static unsigned cube(BlockBits word, unsigned offset) {
    return static_cast<unsigned>(word >> (offset % 64)) & 0xFFU;
  }
  [[nodiscard]] BlockBits free(std::size_t word) const { return marks_.free[word] & ~marks_.occupied[word]; }
  [[nodiscard]] BlockBits occupied(std::size_t word) const { return marks_.occupied[word]; }

  BlockMarks marks_;
  BrickSet any_free_{};
  BrickSet all_free_{};
  BrickSet any_occupied_{};
  BrickSet all_occupied_{};
};

template <unsigned level>
Coverage BlockView::coverage(unsigned offset) const {
  static_assert(level >= 2 && level <= kBlockLevel);
  if constexpr (level == 2) {
    const BlockBits f = free(offset / 64);
    const BlockBits o = occupied(offset / 64);
    return {f != 0, f == ~BlockBits{0}, o != 0, o == ~BlockBits{0}};
  } else if constexpr (level == kBlockLevel) {
    const auto any = [](const BrickSet& set) {
      BlockBits bits = 0;
      for (const BlockBits word : set) bits |= word;
      return bits != 0;
    };
    const auto all = [](const BrickSet& set) {
      BlockBits bits = ~BlockBits{0};
      for (const BlockBits word : set) bits &= word;
      return bits == ~BlockBits{0};
    };
    return {any(any_free_), all(all_free_), any(any_occupied_), all(all_occupied_)};
  } else {
    // 1, 8 or 64 bricks: bits of one word.
    constexpr unsigned kCount = 1U << (3 * (level - 3));
    constexpr BlockBits kMask = ~BlockBits{0} >> (64 - kCount);
    const unsigned brick = offset / 512;
    const auto bits = [brick](const BrickSet& set) { return set[brick / 64] >> (brick % 64) & kMask; };
    return {bits(any_free_) != 0, bits(all_free_) == kMask, bits(any_occupied_) != 0,
            bits(all_occupied_) == kMask};
  }
}

}  // namespace hoctomap::engine
