// SPDX-License-Identifier: BSD-3-Clause
#include "VoxelBlocks.h"

#include <algorithm>
#include <bit>
#include <new>

namespace hoctomap::engine {

namespace {

constexpr unsigned kMaxStageLevels = 5;       // 2^15 entries
constexpr std::size_t kMaxBlocksAChunk = 32;  // 1 MB

}  // namespace

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

VoxelBlocks::VoxelBlocks(const BlockFrame& frame)
    : stage_bits_(3 * std::min(frame.levels(), kMaxStageLevels)),
      stage_mask_((Code{1} << stage_bits_) - 1),
      void_(std::make_unique<BlockBits[]>(kBlockWords)),
      stages_(std::size_t{1} << (3 * frame.levels() - stage_bits_), addStage()) {}

BlockBits** VoxelBlocks::addStage() {
  const auto size = static_cast<std::size_t>(stage_mask_) + 1;
  own_stages_.push_back(std::make_unique<BlockBits*[]>(size));
  std::fill_n(own_stages_.back().get(), size, void_.get());
  return own_stages_.back().get();
}

BlockBits* VoxelBlocks::create(Code local_block) {
  BlockBits**& stage = stages_[static_cast<std::size_t>(local_block >> stage_bits_)];
  if (stage == own_stages_.front().get()) stage = addStage();
  created_.push_back(local_block);
  return stage[static_cast<std::size_t>(local_block & stage_mask_)] = allocate();
}

BlockBits* VoxelBlocks::allocate() {
  if (blocks_left_ == 0) {
    blocks_left_ = std::min(created_.size(), kMaxBlocksAChunk);
    // calloc: large chunks come as untouched pages, which cost no memory until a bit is set in them.
    chunk_ = static_cast<BlockBits*>(std::calloc(blocks_left_ * kBlockWords, sizeof(BlockBits)));
    if (chunk_ == nullptr) throw std::bad_alloc();
    chunks_.emplace_back(chunk_);
  }
  --blocks_left_;
  BlockBits* block = chunk_;
  chunk_ += kBlockWords;
  return block;
}

}  // namespace hoctomap::engine
