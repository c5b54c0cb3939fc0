// SPDX-License-Identifier: BSD-3-Clause
#include "MarkedReach.h"

#include <algorithm>
#include <cmath>

namespace hoctomap::engine {

namespace {

constexpr int kWordEdge = 4;
constexpr double kMargin = 1e-4;  // voxels: octomap's directions are rounded to floats, its times to doubles

/// The low 16 bits of x at every second place.
constexpr std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 8U) & 0x00FF'00FFU;
  x = (x | x << 4U) & 0x0F0F'0F0FU;
  x = (x | x << 2U) & 0x3333'3333U;
  return (x | x << 1U) & 0x5555'5555U;
}

constexpr auto kSpread = [] {
  std::array<std::uint32_t, 1 << kDirectionBits> all{};
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = spread(i);
  return all;
}();

constexpr std::uint32_t gather(std::uint32_t x) {
  x &= 0x5555'5555U;
  x = (x | x >> 1U) & 0x3333'3333U;
  x = (x | x >> 2U) & 0x0F0F'0F0FU;
  x = (x | x >> 4U) & 0x00FF'00FFU;
  return (x | x >> 8U) & 0xFFFFU;
}

/// Codes of words by their coordinate along x, in words.
constexpr std::array<std::uint32_t, 512> makeWordCodes() {
  std::array<std::uint32_t, 512> codes{};
  for (std::size_t i = 0; i < codes.size(); ++i)
    codes[i] = static_cast<std::uint32_t>(dilate(static_cast<int>(i)));
  return codes;
}
constexpr auto kWordCodes = makeWordCodes();
static_assert(kWordCodes.size() * kWordEdge == std::size_t{1} << (kBlockLevel + BlockFrame::kMaxLevels));

/// The voxels of a word whose coordinate along an axis lies between two of its four.
using Masks = std::array<std::array<std::array<BlockBits, kWordEdge>, kWordEdge>, 3>;
constexpr Masks makeMasks() {
  Masks masks{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (Code voxel = 0; voxel < 64; ++voxel) {
      const auto at = static_cast<std::size_t>(compact(voxel >> axis));
      for (std::size_t first = 0; first <= at; ++first) {
        for (std::size_t last = at; last < kWordEdge; ++last) {
          masks[axis][first][last] |= BlockBits{1} << static_cast<unsigned>(voxel);
        }
      }
    }
  }
  return masks;
}
constexpr Masks kMasks = makeMasks();

}  // namespace

Direction directionOf(const Eigen::Vector3f& v) {
  const std::array<float, 3> length{std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])};
  std::size_t axis = length[1] > length[0] ? 1 : 0;
  if (length[2] > length[axis]) axis = 2;
  constexpr int kCells = 1 << kDirectionBits;
  const float scale = 0.5F * kCells / length[axis];
  const std::array<float, 5> twice{v[0], v[1], v[2], v[0], v[1]};
  const auto cell = [&](std::size_t other) {
    const int at = static_cast<int>(twice[other] * scale + 0.5F * kCells);
    return kSpread[static_cast<std::size_t>(std::min(at, kCells - 1))];
  };
  const auto face = static_cast<std::uint32_t>(2 * axis + (twice[axis] < 0.0F ? 1 : 0));
  return face << (2 * kDirectionBits) | cell(axis + 2) << 1U | cell(axis + 1);
}

MarkedReach::MarkedReach(const VoxelGrid& grid, const Eigen::Vector3f& origin, const BlockFrame& frame,
                         VoxelBits& voxels)
    : edge_(1 << (kBlockLevel + frame.levels())), bits_(voxels) {
  for (unsigned bits = kCoarsest; bits <= kFinest; ++bits)
    reach_[bits - kCoarsest].resize(std::size_t{6} << (2 * bits));
  for (std::size_t i = 0; i < 3; ++i) {
    const double at = static_cast<double>(origin[static_cast<Eigen::Index>(i)]) * grid.cellsPerMetre();
    origin_[i] = at + kKeyOffset - frame.corner()[i];
    origin_key_[i] = grid.checkedKey(origin[static_cast<Eigen::Index>(i)]) - frame.corner()[i];
  }
}

/// The rays of a cell of directions.
struct MarkedReach::Cone {
  /// @param bits of the code, an axis.
  Cone(Direction code, unsigned bits)
      : along(code >> (2 * bits + 1)),
        across((along + 1) % 3),
        up((along + 2) % 3),
        sign((code >> (2 * bits) & 1U) != 0 ? -1 : 1) {
    const unsigned mask = (1U << bits) - 1;
    const std::array<std::uint32_t, 2> cell{gather(code) & mask, gather(code >> 1U) & mask};
    const double width = 2.0 / (1U << bits);
    for (std::size_t i = 0; i < 2; ++i) {
      constexpr double kSlopeError = 1e-5;
      low[i] = cell[i] * width - 1.0 - kSlopeError;
      high[i] = (cell[i] + 1) * width - 1.0 + kSlopeError;
    }
  }
  /// Cells along one of the two other axes that they can meet between two distances from the sensor, measured
  /// along the main axis in voxels.
  [[nodiscard]] Range cellsMet(double from, std::size_t axis, double near, double far) const {
    return {floorOf(from + low[axis] * (low[axis] < 0 ? far : near) - kMargin),
            floorOf(from + high[axis] * (high[axis] < 0 ? near : far) + kMargin)};
  }
  static int floorOf(double x) {
    constexpr int kShift = 1 << 20;  // x is greater than -kShift
    return static_cast<int>(x + kShift) - kShift;
  }

  std::size_t along;
  std::size_t across;
  std::size_t up;
  int sign;
  std::array<double, 2> low;
  std::array<double, 2> high;
};

int MarkedReach::stepsMarked(Direction direction, unsigned bits) {
  const Direction code = direction >> (2 * (kDirectionBits - bits));
  Reach& reach = reach_[bits - kCoarsest][code];
  if (reach.round == round_) return reach.steps;
  reach.round = round_;
  int steps = reach.steps;
  if (bits > kCoarsest)
    steps = std::max(steps, stepsMarked(direction, bits - 1));  // a wider cone's hold for this one
  reach.steps = static_cast<std::uint16_t>(follow(Cone(code, bits), steps));
  return reach.steps;
}

/// Goes on from so many steps.
int MarkedReach::follow(const Cone& cone, int steps) const {
  const int key = origin_key_[cone.along];
  const double inside = origin_[cone.along] - key;
  const double to_border = cone.sign < 0 ? inside : 1.0 - inside;
  const int start = cone.sign < 0 ? edge_ - 1 - key : key;
  while (start + steps < edge_) {
    const int layers = kWordEdge - (start + steps) % kWordEdge;
    const Range slab{steps, steps + layers - 1};
    if (!allMarked(cone, slab, std::max(0.0, to_border + slab.first - 1), to_border + slab.last)) break;
    steps += layers;
  }
  return steps;
}

/// True if all cells that the cone's rays meet at these steps, between two distances, are marked.
bool MarkedReach::allMarked(const Cone& cone, const Range& steps, double near, double far) const {
  std::array<Range, 3> cells;
  const int key = origin_key_[cone.along];
  cells[cone.along] =
      cone.sign < 0 ? Range{key - steps.last, key - steps.first} : Range{key + steps.first, key + steps.last};
  cells[cone.across] = cone.cellsMet(origin_[cone.across], 0, near, far);
  cells[cone.up] = cone.cellsMet(origin_[cone.up], 1, near, far);
  if (allMarked(cells)) return true;
  // Fewer cells lie around a thinner slab.
  if (steps.first < steps.last) {
    const int half = (steps.first + steps.last) / 2;
    const double middle = far - (steps.last - half);
    return allMarked(cone, {steps.first, half}, near, middle) &&
           allMarked(cone, {half + 1, steps.last}, middle, far);
  }
  constexpr int kNear = 32;
  constexpr double kThinnest = 1.0 / 8;
  if (steps.first > kNear || far - near < kThinnest) return false;
  const double middle = 0.5 * (near + far);
  return allMarked(cone, steps, near, middle) && allMarked(cone, steps, middle, far);
}

bool MarkedReach::allMarked(const std::array<Range, 3>& cells) const {
  for (const Range& range : cells) {
    if (range.first < 0 || range.last >= edge_) return false;
  }
  const auto mask = [&cells](std::size_t axis, int word) {
    const int first = std::max(cells[axis].first - word * kWordEdge, 0);
    const int last = std::min(cells[axis].last - word * kWordEdge, kWordEdge - 1);
    return kMasks[axis][static_cast<std::size_t>(first)][static_cast<std::size_t>(last)];
  };
  const auto words = [&cells](std::size_t axis) {
    return Range{cells[axis].first / kWordEdge, cells[axis].last / kWordEdge};
  };
  const auto code = [](int word) { return kWordCodes[static_cast<std::size_t>(word)]; };
  for (int z = words(2).first; z <= words(2).last; ++z) {
    for (int y = words(1).first; y <= words(1).last; ++y) {
      const BlockBits mask_yz = mask(1, y) & mask(2, z);
      const std::uint32_t code_yz = code(y) << 1U | code(z) << 2U;
      for (int x = words(0).first; x <= words(0).last; ++x) {
        const std::size_t word = code_yz | code(x);
        // Pages without marks are not read: that would take memory for them.
        if (bits_.pages()[word / kPageWords] == 0) return false;
        if ((~bits_.words()[word] & mask_yz & mask(0, x)) != 0) return false;
      }
    }
  }
  return true;
}

}  // namespace hoctomap::engine
