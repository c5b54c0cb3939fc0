// SPDX-License-Identifier: BSD-3-Clause
#include "BlockView.h"

namespace hoctomap::engine {

BlockView::BlockView(const BlockMarks& marks) : marks_(marks) {
  constexpr std::size_t kBricksAPage = kBricks / kBlockPages;
  for (std::size_t brick = 0; brick < kBricks; ++brick) {
    const std::size_t page = brick / kBricksAPage;
    // Pages without marks are not read: that would take memory for them.
    if (brick % kBricksAPage == 0 &&
        ((marks_.free_pages | marks_.occupied_pages) >> (8 * page) & 0xFFU) == 0) {
      brick += kBricksAPage - 1;
      continue;
    }
    BlockBits any_free = 0;
    BlockBits all_free = ~BlockBits{0};
    BlockBits any_occupied = 0;
    BlockBits all_occupied = ~BlockBits{0};
    for (std::size_t word = 8 * brick; word < 8 * brick + 8; ++word) {
      any_free |= free(word);
      all_free &= free(word);
      any_occupied |= occupied(word);
      all_occupied &= occupied(word);
    }
    const std::size_t place = brick % 64;
    any_free_[brick / 64] |= BlockBits{any_free != 0} << place;
    all_free_[brick / 64] |= BlockBits{all_free == ~BlockBits{0}} << place;
    any_occupied_[brick / 64] |= BlockBits{any_occupied != 0} << place;
    all_occupied_[brick / 64] |= BlockBits{all_occupied == ~BlockBits{0}} << place;
  }
}

}  // namespace hoctomap::engine
