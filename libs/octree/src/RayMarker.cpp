// SPDX-License-Identifier: BSD-3-Clause
#include "RayMarker.h"

#include <algorithm>
#include <utility>

#include "FixedRayMarker.h"
#include "LaneMath.h"
#include "WideRayMarker.h"

namespace hoctomap::engine {

namespace {

/// Several traversals, by axis: see RayBatch.
template <std::size_t lanes>
struct Traversals {
  using Doubles = typename Lanes<lanes>::Doubles;
  using Codes = typename Lanes<lanes>::Codes;

  HOCTOMAP_INLINE Traversals(const RayBatch& batch, const std::uint16_t* rays) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const std::size_t ray = rays[lane];
      for (std::size_t i = 0; i < 3; ++i) {
        next[i][lane] = batch.next[i][ray];
        delta[i][lane] = batch.delta[i][ray];
        place[i][lane] = batch.place[i][ray];
      }
      mirror[lane] = batch.mirror[ray];
      margin[lane] = batch.margin[ray];
      cells[lane] = batch.cells[ray];
    }
    gap = Doubles{} + std::numeric_limits<double>::max();
    before = Doubles{} - std::numeric_limits<double>::max();
  }

  /// Adds `value` where the mask is set, else zero.
  HOCTOMAP_INLINE static void addWhere(Doubles& sum, const Doubles& value, const Codes& mask) {
    sum += reinterpret_cast<Doubles>(reinterpret_cast<Codes>(value) & mask);
  }

  /// Takes each lane to its next cell. No branch depends on the rays: the earliest crossing (octomap's order:
  /// see nextAxis) is found by masks, and the other axes add zero, which changes no time and no place.
  HOCTOMAP_INLINE void step() {
    const Codes x_before_y = next[0] < next[1];
    const Codes x_before_z = next[0] < next[2];
    const Codes y_before_z = next[1] < next[2];
    const Codes x = x_before_y & x_before_z;
    const Codes y = ~x_before_y & y_before_z;
    const Codes z = ~(x | y);
    const Doubles first = lesser(lesser(next[0], next[1]), next[2]);
    gap = lesser(gap, first - before);
    before = first;
    addWhere(next[0], delta[0], x);
    addWhere(next[1], delta[1], y);
    addWhere(next[2], delta[2], z);
    // A mask is -1 where set: this adds 1, and the carry runs over the other axes' bits, which are all set.
    place[0] = (place[0] - x) | ~kAxisPlaces[0];
    place[1] = (place[1] - y) | ~kAxisPlaces[1];
    place[2] = (place[2] - z) | ~kAxisPlaces[2];
  }
  HOCTOMAP_INLINE void cell(Codes& code) const { code = (place[0] & place[1] & place[2]) ^ mirror; }

  Doubles next[3];
  Doubles delta[3];
  Codes place[3];
  Codes mirror;
  Codes cells;
  Doubles margin;
  Doubles gap;     ///< the shortest time between two crossings so far
  Doubles before;  ///< the time of the last one
};

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

template <std::size_t lanes>
HOCTOMAP_INLINE bool mark(const RayBatch& batch, const std::uint16_t* rays, BlockBits* words,
                          std::uint8_t* pages) {
  using Codes = typename Lanes<lanes>::Codes;
  constexpr Code kChunk = 32;  // the edge of a page: along an axis a chunk crosses one border at most
  Code codes[kChunk * lanes];
  Traversals<lanes> t(batch, rays);
  Code longest = 0;
  for (std::size_t lane = 0; lane < lanes; ++lane) longest = std::max(longest, batch.cells[rays[lane]]);
  Codes last;  // of the cells so far: where a ray that has ended stays
  t.cell(last);
  for (Code done = 0; done < longest; done += kChunk) {
    const Code count = std::min(kChunk, longest - done);
    Codes first;
    t.cell(first);
    first = t.cells > done ? first : last;
    for (Code i = 0; i < count; ++i) {
      Codes code;
      t.cell(code);
      last = t.cells > done + i ? code : last;
      store(last, codes + static_cast<std::size_t>(i) * lanes);
      t.step();
    }
    if (anyOf(t.gap < t.margin)) return false;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count) * lanes; ++i) setBit(words, codes[i]);
    for (std::size_t lane = 0; lane < lanes; ++lane) flagPages(pages, first[lane], last[lane]);
  }
  return true;
}

bool markBaseline(const RayBatch& batch, const std::uint16_t* rays, BlockBits* words, std::uint8_t* pages) {
  return mark<kNarrowLanes>(batch, rays, words, pages);
}

HOCTOMAP_TARGET_AVX2 bool markAvx2(const RayBatch& batch, const std::uint16_t* rays, BlockBits* words,
                                   std::uint8_t* pages) {
  return mark<kNarrowLanes>(batch, rays, words, pages);
}

}  // namespace

RayMarker::RayMarker(const RayFan& fan, VoxelBits& bits, InstructionSet set)
    : fan_(fan),
      bits_(bits),
      preparation_(choosePreparation(set)),
      mark_(set == InstructionSet::avx512 ? &markWide
            : set == InstructionSet::avx2 ? &markAvx2
                                          : &markBaseline),
      lanes_(set == InstructionSet::avx512 ? kWideLanes : kNarrowLanes),
      fixed_(set == InstructionSet::avx512 && fan.mirror_places >> kFixedCodeBits == 0) {}

void RayMarker::add(const Eigen::Vector3f& end, std::size_t skip_axis, int skip_steps) {
  const std::size_t at = ends_.count++;
  for (std::size_t i = 0; i < 3; ++i) ends_.end[i][at] = end[static_cast<Eigen::Index>(i)];
  ends_.skip_steps[at] = skip_steps;
  ends_.skip_axis[at] = static_cast<Code>(skip_axis);
  ends_.skips |= skip_steps > 0;
  if (ends_.count == kBatch) markBatch();
}

void RayMarker::finish() {
  if (ends_.count > 0) markBatch();
}

void RayMarker::markBatch() {
  for (std::size_t at = 0; at < ends_.count; at += preparation_.lanes) {
    preparation_.prepare(fan_, ends_, at, batch_);
  }
  Order order;
  std::size_t count = orderByLength(order);
  // The last rays fill the lanes: marking a cell again does no harm.
  const std::size_t group = fixed_ ? kFixedLanes : lanes_;
  for (; count % group != 0; ++count) order[count] = order[count - 1];
  for (std::size_t first = 0; first < count; first += group) {
    if (fixed_ && markFixed(batch_, &order[first], bits_.words(), bits_.pages())) continue;
    for (std::size_t at = first; at < first + group; at += lanes_) markGroup(&order[at]);
  }
  ends_.count = 0;
  ends_.skips = false;
}

/// `lanes_` rays.
void RayMarker::markGroup(const std::uint16_t* rays) {
  if (mark_(batch_, rays, bits_.words(), bits_.pages())) return;
  for (std::size_t lane = 0; lane < lanes_; ++lane) addSpecial(rays[lane]);
}

/// Rays with cells to be marked, the shortest first. @return their number.
std::size_t RayMarker::orderByLength(Order& order) {
  // By buckets: nearly as long will do.
  constexpr std::size_t kBuckets = 256;
  constexpr unsigned kWidth = 2;  // 2^2 cells
  std::array<std::uint16_t, kBuckets> places{};
  std::array<std::uint8_t, kBatch> bucket;
  std::array<std::uint16_t, kBatch> rays;
  std::size_t count = 0;
  for (std::size_t ray = 0; ray < ends_.count; ++ray) {
    const Code cells = batch_.cells[ray];
    if (cells == RayBatch::kSpecial) addSpecial(ray);
    if (cells <= 0) continue;
    const std::size_t b = std::min(static_cast<std::size_t>(cells) >> kWidth, kBuckets - 1);
    bucket[count] = static_cast<std::uint8_t>(b);
    rays[count++] = static_cast<std::uint16_t>(ray);
    ++places[b];
  }
  std::uint16_t sum = 0;
  for (std::uint16_t& place : places) sum = static_cast<std::uint16_t>(sum + std::exchange(place, sum));
  for (std::size_t i = 0; i < count; ++i) order[places[bucket[i]]++] = rays[i];
  return count;
}

void RayMarker::addSpecial(std::size_t ray) {
  special_.emplace_back(ends_.end[0][ray], ends_.end[1][ray], ends_.end[2][ray]);
}

}  // namespace hoctomap::engine
