// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "MortonCode.h"

namespace hoctomap::engine {

/// Edge of a block: 2^6 = 64 voxels, a node of the octree 6 levels above the voxels.
inline constexpr unsigned kBlockLevel = 6;
inline constexpr unsigned kBlockCodeBits = 3 * kBlockLevel;
inline constexpr std::size_t kBlockWords = std::size_t{1} << (kBlockCodeBits - 6);

/// A page of memory, 4 KB, holds 32^3 voxels: 8 pages a block.
inline constexpr unsigned kPageCodeBits = 15;
inline constexpr std::size_t kPageWords = std::size_t{1} << (kPageCodeBits - 6);
inline constexpr std::size_t kBlockPages = kBlockWords / kPageWords;

/// One bit a voxel, in Morton order: a byte is 2^3 voxels, a word 4^3, a cache line 8^3.
using BlockBits = std::uint64_t;

/// Sets the bit of the voxel `code`.
inline void setBit(BlockBits* words, Code code) {
  const auto place = static_cast<std::uint64_t>(code);
  words[place >> 6U] |= BlockBits{1} << (place & 63U);
}

/// The cube of blocks, aligned to blocks, around a box of keys. Codes count from its corner ("local"), so
/// that the bitmap is small wherever the box lies.
class BlockFrame {
 public:
  /// 2^5 blocks an edge: 2048^3 voxels, 1 GB of addresses.
  static constexpr unsigned kMaxLevels = 5;

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
  /// Number of blocks in the cube.
  [[nodiscard]] std::size_t blocks() const { return std::size_t{1} << (3 * levels_); }

 private:
  Key corner_;
  unsigned levels_;
};

/// A set of voxels of a cube: one contiguous bitmap in Morton order. Addresses are reserved for the whole
/// cube; memory is taken page by page where bits are set, and up to `kMaxKeptPages` are kept for the next
/// scan.
class VoxelBits {
 public:
  static constexpr std::size_t kMaxKeptPages = 2048;  // 8 MB

  VoxelBits() = default;
  VoxelBits(const VoxelBits&) = delete;
  VoxelBits& operator=(const VoxelBits&) = delete;
  VoxelBits(VoxelBits&&) = delete;
  VoxelBits& operator=(VoxelBits&&) = delete;
  ~VoxelBits();

  /// Makes room for the cube of a frame. The set must be empty.
  /// @throws std::bad_alloc if the addresses cannot be reserved.
  void open(const BlockFrame& frame);

  /// @param code local code of a voxel inside the frame.
  void mark(Code code) {
    setBit(words_, code);
    pages_[static_cast<std::size_t>(code >> kPageCodeBits)] = 1;
  }

  [[nodiscard]] BlockBits* words() const { return words_; }
  /// One flag a page: 0 only if no bit of it is set. Who sets bits by hand sets the flags, too.
  [[nodiscard]] std::uint8_t* pages() { return pages_.data(); }

  [[nodiscard]] const BlockBits* block(Code local_block) const {
    return words_ + static_cast<std::size_t>(local_block) * kBlockWords;
  }
  /// The flags of a block's pages, the first in the lowest byte.
  [[nodiscard]] std::uint64_t blockPages(Code local_block) const;

  /// Adds another set of the same frame.
  void unite(const VoxelBits& other);

  /// Takes back the flags of pages without bits.
  void unflagEmptyPages();

  /// Empties the set.
  void clear();

  /// From now on `clear` keeps the memory of at most so many pages.
  void keepAtMost(std::size_t pages) { max_kept_ = pages; }

 private:
  void release();

  BlockBits* words_ = nullptr;
  std::size_t reserved_ = 0;            ///< words
  std::vector<std::uint8_t> resident_;  ///< one flag a reserved page: it has memory
  std::size_t resident_count_ = 0;
  std::size_t max_kept_ = kMaxKeptPages;
  std::vector<std::uint8_t> pages_;
};

}  // namespace hoctomap::engine
