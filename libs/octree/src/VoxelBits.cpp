// SPDX-License-Identifier: BSD-3-Clause
#include "VoxelBits.h"

#include <sys/mman.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <new>

#include "hoctomap/geometry/ForEachIndex.h"

namespace hoctomap::engine {

BlockFrame::BlockFrame(const KeyBox& box) : corner_{0, 0, 0}, levels_(0) {
  if (box.empty()) return;
  for (std::size_t i = 0; i < 3; ++i) {
    const int first = box.min[i] >> kBlockLevel;
    const int last = box.max[i] >> kBlockLevel;
    corner_[i] = first << kBlockLevel;
    levels_ = std::max(levels_, static_cast<unsigned>(std::bit_width(static_cast<unsigned>(last - first))));
  }
}

Code BlockFrame::treeCode(Code local_block) const {
  Key block = keyOf(local_block);
  for (std::size_t i = 0; i < 3; ++i) block[i] += corner_[i] >> kBlockLevel;
  return codeOf(block);
}

VoxelBits::~VoxelBits() {
  release();
}

void VoxelBits::release() {
  if (words_ != nullptr) munmap(words_, reserved_ * sizeof(BlockBits));
  words_ = nullptr;
  reserved_ = 0;
}

void VoxelBits::open(const BlockFrame& frame) {
  const std::size_t words = frame.blocks() * kBlockWords;
  if (words > reserved_) {
    release();
    void* memory = mmap(nullptr, words * sizeof(BlockBits), PROT_READ | PROT_WRITE,
                        MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    // Huge pages would take memory for voxels that no beam comes near.
    madvise(memory, words * sizeof(BlockBits), MADV_NOHUGEPAGE);
    words_ = static_cast<BlockBits*>(memory);
    reserved_ = words;
    resident_.assign(words / kPageWords, 0);
    resident_count_ = 0;
  }
  pages_.assign(words / kPageWords, 0);
}

std::uint64_t VoxelBits::blockPages(Code local_block) const {
  static_assert(kBlockPages == sizeof(std::uint64_t));
  std::uint64_t flags = 0;
  std::memcpy(&flags, pages_.data() + static_cast<std::size_t>(local_block) * kBlockPages, sizeof flags);
  return flags;
}

void VoxelBits::unite(const VoxelBits& other) {
  tbb::this_task_arena::isolate([&] {
    forEachIndex(pages_.size(), [&](std::size_t page) {
      if (other.pages_[page] == 0) return;
      BlockBits* to = words_ + page * kPageWords;
      const BlockBits* from = other.words_ + page * kPageWords;
      for (std::size_t i = 0; i < kPageWords; ++i) to[i] |= from[i];
      pages_[page] = 1;
    });
  });
}

void VoxelBits::unflagEmptyPages() {
  for (std::size_t page = 0; page < pages_.size(); ++page) {
    if (pages_[page] == 0) continue;
    const BlockBits* words = words_ + page * kPageWords;
    if (std::all_of(words, words + kPageWords, [](BlockBits word) { return word == 0; })) pages_[page] = 0;
  }
}

void VoxelBits::clear() {
  for (std::size_t page = 0; page < pages_.size(); ++page) {
    if (pages_[page] != 0 && resident_[page] == 0) {
      resident_[page] = 1;
      ++resident_count_;
    }
  }
  // Fresh memory costs ten times as much as memory in use: only a large scan gives its pages back.
  const bool keep = resident_count_ <= max_kept_;
  for (std::size_t page = 0; keep && page < pages_.size(); ++page) {
    if (pages_[page] != 0) std::memset(words_ + page * kPageWords, 0, kPageWords * sizeof(BlockBits));
  }
  if (!keep) {
    madvise(words_, reserved_ * sizeof(BlockBits), MADV_DONTNEED);
    std::fill(resident_.begin(), resident_.end(), std::uint8_t{0});
    resident_count_ = 0;
  }
  std::fill(pages_.begin(), pages_.end(), std::uint8_t{0});
}

}  // namespace hoctomap::engine
