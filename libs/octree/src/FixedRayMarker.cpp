// SPDX-License-Identifier: BSD-3-Clause
#include "FixedRayMarker.h"

#include <algorithm>
#include <cstdlib>

#if defined(__x86_64__)

#include <immintrin.h>

namespace hoctomap::engine {

namespace {

#define HOCTOMAP_INLINE_AVX512 [[gnu::always_inline]] HOCTOMAP_TARGET_AVX512 inline

constexpr std::size_t kLanes = 16;
constexpr int kSteps = 32;     // between two writes
constexpr int kStretch = 128;  // the longer, the more rays are in doubt: by the third power
constexpr double kUnits = 1 << 30;

/// Words and the bits to be set in them, from all lanes, in the order in which they came.
struct WordList {
  alignas(64) std::uint32_t words[(kSteps + 2) * kFixedLanes];
  alignas(64) std::uint32_t low[(kSteps + 2) * kFixedLanes];
  alignas(64) std::uint32_t high[(kSteps + 2) * kFixedLanes];
};

/// What a batch holds of eight rays.
struct EightRays {
  HOCTOMAP_INLINE_AVX512 EightRays(const RayBatch& batch, const std::uint16_t* numbers) {
    const __m256i rays = _mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(numbers)));
    for (std::size_t i = 0; i < 3; ++i) {
      next[i] = _mm512_i32gather_pd(rays, batch.next[i], sizeof(double));
      delta[i] = _mm512_i32gather_pd(rays, batch.delta[i], sizeof(double));
      place[i] = lowHalves(rays, batch.place[i]);
    }
    mirror = lowHalves(rays, batch.mirror);
    cells = lowHalves(rays, batch.cells);
    pace = _mm512_add_pd(_mm512_add_pd(_mm512_rcp14_pd(delta[0]), _mm512_rcp14_pd(delta[1])),
                         _mm512_rcp14_pd(delta[2]));
  }
  HOCTOMAP_INLINE_AVX512 static __m256i lowHalves(__m256i rays, const Code* from) {
    return _mm512_cvtepi64_epi32(_mm512_i32gather_epi64(rays, from, sizeof *from));
  }

  __m512d next[3];
  __m512d delta[3];
  __m512d pace;  ///< crossings of all axes in a unit of time, but for 2^-14 of it
  __m256i place[3];
  __m256i mirror;
  __m256i cells;
};

/// A stretch of eight rays, with units of its own.
struct FixedTimes {
  /// @param taken crossings before the stretch, by axis. @param cells of the stretch.
  HOCTOMAP_INLINE_AVX512 FixedTimes(const EightRays& rays, const __m256i* taken, __m256i cells) {
    __m512d time[3];
    for (std::size_t i = 0; i < 3; ++i) {
      // An axis without a crossing has none taken, and an endless delta.
      time[i] = _mm512_add_pd(rays.next[i], _mm512_mul_pd(_mm512_cvtepi32_pd(taken[i]), rays.delta[i]));
    }
    const __m512d start = _mm512_min_pd(_mm512_min_pd(time[0], time[1]), time[2]);
    // In a time T after `start` there are at least T * pace - 3 crossings: all that matter lie within
    // (cells + 4) / pace. One more covers the errors of the reciprocals.
    const __m512d count = _mm512_cvtepi32_pd(cells);
    const __m512d reach = _mm512_add_pd(count, _mm512_set1_pd(5.0));
    const __m512d scale =
        _mm512_mul_pd(_mm512_set1_pd(kUnits), _mm512_mul_pd(rays.pace, _mm512_rcp14_pd(reach)));
    for (std::size_t i = 0; i < 3; ++i) {
      next[i] = toUnits(_mm512_mul_pd(_mm512_sub_pd(time[i], start), scale));
      delta[i] = toUnits(_mm512_mul_pd(rays.delta[i], scale));
    }
    // Half a unit on conversion and at every addition, and by what times from product and sum differ from
    // octomap's (see RayBatch), for both of two times.
    const __m512d end = _mm512_add_pd(_mm512_mul_pd(start, scale), _mm512_set1_pd(kUnits));
    const __m512d octomaps = _mm512_mul_pd(_mm512_set1_pd(1e-10), _mm512_add_pd(scale, end));
    margin = toUnits(_mm512_add_pd(_mm512_mul_pd(_mm512_set1_pd(0.5), count),
                                   _mm512_add_pd(_mm512_set1_pd(3.0), octomaps)));
  }

  /// What lies beyond the stretch stays there: the sum of two such numbers is no more than 2^31 - 2.
  HOCTOMAP_INLINE_AVX512 static __m256i toUnits(__m512d time) {
    return _mm512_cvtpd_epi32(_mm512_min_pd(time, _mm512_set1_pd(kUnits - 1.0)));
  }

  __m256i next[3];
  __m256i delta[3];
  __m256i margin;  ///< the order of two times as close as that is not certain
};

HOCTOMAP_INLINE_AVX512 __m512i join(__m256i a, __m256i b) {
  return _mm512_inserti64x4(_mm512_castsi256_si512(a), b, 1);
}

template <int shift>
HOCTOMAP_INLINE_AVX512 __m512i fold(__m512i x, int mask) {
  return _mm512_and_si512(_mm512_or_si512(x, _mm512_srli_epi32(x, shift)), _mm512_set1_epi32(mask));
}
/// As `compact`, for ten bits.
HOCTOMAP_INLINE_AVX512 __m512i compactLanes(__m512i code) {
  const __m512i x = _mm512_and_si512(code, _mm512_set1_epi32(0x0924'9249));
  return fold<16>(fold<8>(fold<4>(fold<2>(x, 0x030C'30C3), 0x0300'F00F), 0x0300'00FF), 0x3FF);
}

/// The same steps as in RayMarker.cpp.
class Walk {
 public:
  HOCTOMAP_INLINE_AVX512 Walk(const RayBatch& batch, const std::uint16_t* numbers)
      : a_(batch, numbers), b_(batch, numbers + kLanes / 2) {
    place_x_ = join(a_.place[0], b_.place[0]);
    place_y_ = join(a_.place[1], b_.place[1]);
    place_z_ = join(a_.place[2], b_.place[2]);
    mirror_ = join(a_.mirror, b_.mirror);
    cells_ = join(a_.cells, b_.cells);
    for (std::size_t i = 0; i < 3; ++i) start_[i] = coordinate(i);
    word_ = _mm512_srli_epi32(code(), 6);
    low_ = _mm512_setzero_si512();
    high_ = _mm512_setzero_si512();
  }

  [[nodiscard]] HOCTOMAP_INLINE_AVX512 int longest() const { return _mm512_reduce_max_epi32(cells_); }

  /// Takes new units of time. @param done cells of each lane so far
  HOCTOMAP_INLINE_AVX512 void beginStretch(int done) {
    const __m512i left = _mm512_sub_epi32(cells_, _mm512_set1_epi32(done));
    const __m512i cells =
        _mm512_min_epi32(_mm512_max_epi32(left, _mm512_setzero_si512()), _mm512_set1_epi32(kStretch));
    __m256i taken_a[3];
    __m256i taken_b[3];
    for (std::size_t i = 0; i < 3; ++i) {
      const __m512i taken = _mm512_sub_epi32(coordinate(i), start_[i]);
      taken_a[i] = _mm512_castsi512_si256(taken);
      taken_b[i] = _mm512_extracti64x4_epi64(taken, 1);
    }
    const FixedTimes a(a_, taken_a, _mm512_castsi512_si256(cells));
    const FixedTimes b(b_, taken_b, _mm512_extracti64x4_epi64(cells, 1));
    next_x_ = join(a.next[0], b.next[0]);
    next_y_ = join(a.next[1], b.next[1]);
    next_z_ = join(a.next[2], b.next[2]);
    delta_x_ = join(a.delta[0], b.delta[0]);
    delta_y_ = join(a.delta[1], b.delta[1]);
    delta_z_ = join(a.delta[2], b.delta[2]);
    margin_ = join(a.margin, b.margin);
    before_ = _mm512_set1_epi32(-(1 << 20));
    gap_ = _mm512_set1_epi32(1 << 30);
  }

  /// Marks the cells where the lanes stand, the `done`th of each, and takes them to the next ones.
  HOCTOMAP_INLINE_AVX512 void step(int done, WordList& list, std::size_t& size) {
    const __mmask16 live = _mm512_cmpgt_epi32_mask(cells_, _mm512_set1_epi32(done));
    mark(live, list, size);
    advance(live);
  }

  HOCTOMAP_INLINE_AVX512 void markLast(WordList& list, std::size_t& size) const {
    write(list, size, word_, low_, high_);
    size += kLanes;
  }

  [[nodiscard]] HOCTOMAP_INLINE_AVX512 bool inDoubt() const {
    return _mm512_cmple_epi32_mask(gap_, margin_) != 0;
  }

 private:
  [[nodiscard]] HOCTOMAP_INLINE_AVX512 __m512i code() const {
    return _mm512_xor_si512(_mm512_and_si512(place_x_, _mm512_and_si512(place_y_, place_z_)), mirror_);
  }
  /// How far the lanes have come along an axis.
  [[nodiscard]] HOCTOMAP_INLINE_AVX512 __m512i coordinate(std::size_t axis) const {
    return compactLanes(axis == 0   ? place_x_
                        : axis == 1 ? _mm512_srli_epi32(place_y_, 1)
                                    : _mm512_srli_epi32(place_z_, 2));
  }

  HOCTOMAP_INLINE_AVX512 static void write(WordList& list, std::size_t at, __m512i word, __m512i low,
                                           __m512i high) {
    _mm512_storeu_si512(list.words + at, word);
    _mm512_storeu_si512(list.low + at, low);
    _mm512_storeu_si512(list.high + at, high);
  }

  HOCTOMAP_INLINE_AVX512 void mark(__mmask16 live, WordList& list, std::size_t& size) {
    const __m512i one = _mm512_set1_epi32(1);
    const __m512i code = this->code();
    const __m512i here = _mm512_srli_epi32(code, 6);
    // Shifted by 32 and more, nothing is left: a bit is in the one half or in the other.
    const __m512i place = _mm512_and_si512(code, _mm512_set1_epi32(63));
    const __m512i low = _mm512_maskz_sllv_epi32(live, one, place);
    const __m512i high = _mm512_maskz_sllv_epi32(live, one, _mm512_xor_si512(place, _mm512_set1_epi32(32)));
    const __mmask16 leaves = _mm512_mask_cmpneq_epi32_mask(live, here, word_);
    write(list, size, _mm512_maskz_compress_epi32(leaves, word_), _mm512_maskz_compress_epi32(leaves, low_),
          _mm512_maskz_compress_epi32(leaves, high_));
    size += static_cast<std::size_t>(_mm_popcnt_u32(leaves));
    const __mmask16 stays = _knot_mask16(leaves);
    word_ = _mm512_mask_mov_epi32(word_, leaves, here);
    low_ = _mm512_mask_or_epi32(low, stays, low, low_);
    high_ = _mm512_mask_or_epi32(high, stays, high, high_);
  }

  HOCTOMAP_INLINE_AVX512 void advance(__mmask16 live) {
    // octomap's order: see nextAxis.
    const __mmask16 x_before_y = _mm512_cmplt_epi32_mask(next_x_, next_y_);
    const __mmask16 x_before_z = _mm512_cmplt_epi32_mask(next_x_, next_z_);
    const __mmask16 y_before_z = _mm512_cmplt_epi32_mask(next_y_, next_z_);
    const __mmask16 x = _kand_mask16(x_before_y, x_before_z);
    const __mmask16 y = _kandn_mask16(x_before_y, y_before_z);
    const __mmask16 z = _kxnor_mask16(x, y);  // x and y are never both set
    const __m512i first = _mm512_min_epi32(_mm512_min_epi32(next_x_, next_y_), next_z_);
    gap_ = _mm512_mask_min_epi32(gap_, live, gap_, _mm512_sub_epi32(first, before_));
    before_ = first;
    next_x_ = _mm512_mask_add_epi32(next_x_, x, next_x_, delta_x_);
    next_y_ = _mm512_mask_add_epi32(next_y_, y, next_y_, delta_y_);
    next_z_ = _mm512_mask_add_epi32(next_z_, z, next_z_, delta_z_);
    const __m512i one = _mm512_set1_epi32(1);
    place_x_ = stepPlace(_mm512_mask_add_epi32(place_x_, x, place_x_, one), 0);
    place_y_ = stepPlace(_mm512_mask_add_epi32(place_y_, y, place_y_, one), 1);
    place_z_ = stepPlace(_mm512_mask_add_epi32(place_z_, z, place_z_, one), 2);
  }
  HOCTOMAP_INLINE_AVX512 static __m512i stepPlace(__m512i place, std::size_t axis) {
    return _mm512_or_si512(place, _mm512_set1_epi32(static_cast<int>(~kAxisPlaces[axis])));
  }

  EightRays a_;
  EightRays b_;
  __m512i start_[3];
  __m512i next_x_, next_y_, next_z_;
  __m512i delta_x_, delta_y_, delta_z_;
  __m512i place_x_, place_y_, place_z_;
  __m512i mirror_;
  __m512i cells_;
  __m512i margin_;
  __m512i gap_;     ///< the shortest time between two crossings of this stretch so far
  __m512i before_;  ///< the time of the last one
  __m512i word_;    ///< where the lanes are, and
  __m512i low_;     ///< what they have met of it: bits 0 to 31,
  __m512i high_;    ///< and 32 to 63
};

}  // namespace

HOCTOMAP_TARGET_AVX512 bool markFixed(const RayBatch& batch, const std::uint16_t* rays, BlockBits* words,
                                      std::uint8_t* pages) {
  // Two chains of operations that do not depend on each other.
  static_assert(kFixedLanes == 2 * kLanes);
  Walk a(batch, rays);
  Walk b(batch, rays + kLanes);
  WordList list;
  const int longest = std::max(a.longest(), b.longest());
  for (int done = 0; done < longest;) {
    if (done % kStretch == 0) {
      a.beginStretch(done);
      b.beginStretch(done);
    }
    std::size_t size = 0;
    for (const int stop = std::min(longest, done + kSteps); done < stop; ++done) {
      a.step(done, list, size);
      b.step(done, list, size);
    }
    if (a.inDoubt() || b.inDoubt()) return false;
    if (done == longest) {
      a.markLast(list, size);
      b.markLast(list, size);
    }
    for (std::size_t i = 0; i < size; ++i) {
      words[list.words[i]] |= list.low[i] | BlockBits{list.high[i]} << 32U;
      pages[list.words[i] / kPageWords] = 1;
    }
  }
  return true;
}

}  // namespace hoctomap::engine

#else

namespace hoctomap::engine {

bool markFixed(const RayBatch&, const std::uint16_t*, BlockBits*, std::uint8_t*) {
  std::abort();  // no processor of this architecture has the instructions
}

}  // namespace hoctomap::engine

#endif
