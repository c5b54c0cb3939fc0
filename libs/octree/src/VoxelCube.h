// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "OccupancyOdds.h"
#include "TreeAccess.h"

namespace hoctomap::engine {

/// Four voxels at a time, with instructions that every x86-64 processor has.
using Quad __attribute__((vector_size(4 * sizeof(float)))) = float;
using QuadMask __attribute__((vector_size(4 * sizeof(float)))) = std::int32_t;

/// What OccupancyOdds makes of four voxels.
class QuadOdds {
 public:
  explicit QuadOdds(const OccupancyOdds& odds)
      : miss_(all(odds.miss())), hit_(all(odds.hit())), min_(all(odds.min())), max_(all(odds.max())) {
    constexpr float kNever = std::numeric_limits<float>::infinity();
    miss_keeps_below_ = all(odds.miss() <= 0.0F ? odds.min() : -kNever);
    miss_keeps_above_ = all(odds.miss() >= 0.0F ? odds.max() : kNever);
    hit_keeps_below_ = all(odds.hit() <= 0.0F ? odds.min() : -kNever);
    hit_keeps_above_ = all(odds.hit() >= 0.0F ? odds.max() : kNever);
  }

  /// As OccupancyOdds::updated, where one of the masks is set.
  /// @param touched out: those that octomap would touch
  [[gnu::always_inline]] void update(Quad& values, const QuadMask& free, const QuadMask& occupied,
                                     QuadMask& touched) const {
    const Quad sum = values + ofEither(free, miss_, occupied, hit_);
    const Quad below = sum > max_ ? max_ : sum;
    const Quad clamped = sum < min_ ? min_ : below;
    const QuadMask kept = (values <= ofEither(free, miss_keeps_below_, occupied, hit_keeps_below_)) |
                          (values >= ofEither(free, miss_keeps_above_, occupied, hit_keeps_above_));
    touched = (free | occupied) & ~kept;
    values = ofEither(touched, clamped, ~touched, values);
  }

 private:
  static Quad all(float x) { return Quad{x, x, x, x}; }
  /// `a` and `b` where their masks are set, of which at most one is; else zero.
  [[gnu::always_inline]] static Quad ofEither(const QuadMask& mask_a, const Quad& a, const QuadMask& mask_b,
                                              const Quad& b) {
    return reinterpret_cast<Quad>((reinterpret_cast<QuadMask>(a) & mask_a) |
                                  (reinterpret_cast<QuadMask>(b) & mask_b));
  }

  Quad miss_;
  Quad hit_;
  Quad min_;
  Quad max_;
  Quad miss_keeps_below_;
  Quad miss_keeps_above_;
  Quad hit_keeps_below_;
  Quad hit_keeps_above_;
};

/// The eight voxels of an inner node: read, updated and written all at once, without a branch for each.
class VoxelCube {
 public:
  /// @param children of a node one level above the voxels
  explicit VoxelCube(octomap::AbstractOcTreeNode* const* children) {
    for (unsigned i = 0; i < kOctants; ++i) {
      auto* voxel = static_cast<Node*>(children[i]);
      present_ |= static_cast<unsigned>(voxel != nullptr) << i;
      voxels_[i] = voxel != nullptr ? voxel : &none_;
    }
    for (unsigned i = 0; i < 4; ++i) {
      low_[i] = voxels_[i]->getValue();
      high_[i] = voxels_[i + 4]->getValue();
    }
  }
  VoxelCube(const VoxelCube&) = delete;
  VoxelCube& operator=(const VoxelCube&) = delete;
  VoxelCube(VoxelCube&&) = delete;
  VoxelCube& operator=(VoxelCube&&) = delete;
  ~VoxelCube() = default;

  /// One bit a voxel: it exists.
  [[nodiscard]] unsigned present() const { return present_; }

  /// Updates those of the voxels that exist. @return whether octomap would have touched any.
  bool update(const QuadOdds& odds, unsigned free, unsigned occupied) {
    free &= present_;
    occupied &= present_;
    QuadMask touched_low;
    QuadMask touched_high;
    odds.update(low_, kMasks[free & 15U], kMasks[occupied & 15U], touched_low);
    odds.update(high_, kMasks[free >> 4U], kMasks[occupied >> 4U], touched_high);
    if (!any(touched_low | touched_high)) return false;
    for (unsigned i = 0; i < 4; ++i) {
      voxels_[i]->setValue(low_[i]);
      voxels_[i + 4]->setValue(high_[i]);
    }
    return true;
  }

  void insert(unsigned octant, Node* voxel) {
    present_ |= 1U << octant;
    // Not an element of (low or high): with -fsanitize=undefined, GCC 12 writes that into a copy.
    if (octant < 4) {
      low_[octant] = voxel->getValue();
    } else {
      high_[octant - 4] = voxel->getValue();
    }
  }

  /// Of those that exist.
  [[nodiscard]] float greatest() const {
    constexpr float kLeast = std::numeric_limits<float>::lowest();
    constexpr Quad kLeasts{kLeast, kLeast, kLeast, kLeast};
    const Quad low = kMasks[present_ & 15U] ? low_ : kLeasts;
    const Quad high = kMasks[present_ >> 4U] ? high_ : kLeasts;
    const Quad four = low > high ? low : high;
    return std::max(std::max(four[0], four[1]), std::max(four[2], four[3]));
  }
  /// True if all eight exist and are alike, so that octomap prunes them.
  [[nodiscard]] bool uniform() const {
    if (present_ != 0xFFU) return false;
    const Quad first{low_[0], low_[0], low_[0], low_[0]};
    return !any((low_ != first) | (high_ != first));
  }

 private:
  /// Four bits as a mask.
  static constexpr auto kMasks = [] {
    std::array<QuadMask, 16> masks{};
    for (int bits = 0; bits < 16; ++bits) {
      masks[static_cast<std::size_t>(bits)] =
          QuadMask{-(bits & 1), -(bits >> 1 & 1), -(bits >> 2 & 1), -(bits >> 3 & 1)};
    }
    return masks;
  }();

  static bool any(const QuadMask& mask) {
    using Halves __attribute__((vector_size(sizeof(QuadMask)))) = std::int64_t;
    const auto halves = reinterpret_cast<Halves>(mask);
    return (halves[0] | halves[1]) != 0;
  }

  Node none_;  ///< in the place of those that do not exist
  unsigned present_ = 0;
  std::array<Node*, kOctants> voxels_;
  Quad low_;
  Quad high_;
};

}  // namespace hoctomap::engine
