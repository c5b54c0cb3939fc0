// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

#include "MortonCode.h"

namespace hoctomap::engine {

/// Edge of a block: 2^6 = 64 voxels, a node of the octree 6 levels above the voxels.
inline constexpr unsigned kBlockLevel = 6;
inline constexpr unsigned kBlockCodeBits = 3 * kBlockLevel;
inline constexpr std::size_t kBlockWords = std::size_t{1} << (kBlockCodeBits - 6);

/// One bit a voxel, in Morton order: a byte is 2^3 voxels, a word 4^3, a cache line 8^3.
using BlockBits = std::uint64_t;

/// Sets the bit of the voxel `code` in its block.
inline void setBit(BlockBits* block, Code code) {
  const auto place = static_cast<std::uint64_t>(code);
  block[(place >> 6U) & (kBlockWords - 1)] |= BlockBits{1} << (place & 63U);
}

/// The cube of blocks, aligned to blocks, around a box of keys. Codes count from its corner ("local"), so
/// that the table of blocks is small wherever the box lies.
class BlockFrame {
 public:
  explicit BlockFrame(const KeyBox& box);

  [[nodiscard]] Key toLocal(const Key& key) const {
    return {key[0] - corner_[0], key[1] - corner_[1], key[2] - corner_[2]};
  }
  [[nodiscard]] Code localCode(const Key& key) const { return codeOf(toLocal(key)); }
  /// Code of a block in the whole tree (30 bits), by its local one.
  [[nodiscard]] Code treeCode(Code local_block) const;
  /// Key of local (0, 0, 0).
  [[nodiscard]] const Key& corner() const { return corner_; }
  /// Levels of the cube above the blocks: its edge is 2^levels blocks.
  [[nodiscard]] unsigned levels() const { return levels_; }

 private:
  Key corner_;
  unsigned levels_;
};

/// A set of voxels: a bitmap of blocks that come into being when their first voxel is marked.
///
/// Blocks are found through a table of two stages of at most 2^15 entries; the second stage exists where
/// there are blocks. So the cost of a look-up does not depend on the extent, and a small extent has a small
/// table. The table has no holes: where there is no block it leads to the "void" block, which may be written
/// to and is never read.
class VoxelBlocks {
 public:
  explicit VoxelBlocks(const BlockFrame& frame);

  /// @param code local code of a voxel inside the frame.
  void mark(Code code) { setBit(findOrCreate(code >> kBlockCodeBits), code); }

  /// Makes sure that a block exists. True if it did not.
  bool ensure(Code local_block) {
    if (entry(local_block) != void_.get()) return false;
    create(local_block);
    return true;
  }

  /// The bits of a block; null if it does not exist.
  [[nodiscard]] const BlockBits* find(Code local_block) const {
    const BlockBits* block = entry(local_block);
    return block == void_.get() ? nullptr : block;
  }

  /// Local codes of the blocks that exist, in the order of their creation.
  [[nodiscard]] const std::vector<Code>& created() const { return created_; }

  /// A look-up without members, for the inner loop.
  struct Table {
    BlockBits* const* const* stages;
    unsigned stage_bits;
    Code stage_mask;

    [[nodiscard]] BlockBits* operator[](Code local_block) const {
      return stages[local_block >> stage_bits][local_block & stage_mask];
    }
  };
  [[nodiscard]] Table table() const { return {stages_.data(), stage_bits_, stage_mask_}; }

 private:
  struct Free {
    void operator()(void* memory) const { std::free(memory); }
  };

  [[nodiscard]] BlockBits* entry(Code local_block) const { return table()[local_block]; }
  BlockBits* findOrCreate(Code local_block) {
    BlockBits* block = entry(local_block);
    return block == void_.get() ? create(local_block) : block;
  }
  BlockBits* create(Code local_block);
  BlockBits* allocate();
  BlockBits** addStage();

  unsigned stage_bits_;
  Code stage_mask_;
  std::unique_ptr<BlockBits[]> void_;
  std::vector<std::unique_ptr<BlockBits*[]>> own_stages_;  ///< the first one leads to the void only
  std::vector<BlockBits**> stages_;
  std::vector<Code> created_;
  std::vector<std::unique_ptr<BlockBits, Free>> chunks_;
  BlockBits* chunk_ = nullptr;
  std::size_t blocks_left_ = 0;
};

}  // namespace hoctomap::engine
