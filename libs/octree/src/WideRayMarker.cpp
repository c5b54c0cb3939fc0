// SPDX-License-Identifier: BSD-3-Clause
#include "WideRayMarker.h"

#include <algorithm>
#include <cstdlib>

#if defined(__x86_64__)

#include <immintrin.h>

#include "LaneMath.h"

namespace hoctomap::engine {

namespace {

#define HOCTOMAP_INLINE_AVX512 [[gnu::always_inline]] HOCTOMAP_TARGET_AVX512 inline

constexpr std::size_t kLanes = 8;
constexpr std::size_t kGroups = kWideLanes / kLanes;
constexpr std::size_t kSteps = 32;

/// Words and the bits to be set in them, from all lanes, in the order in which they came.
struct WordList {
  alignas(64) std::uint64_t words[(kSteps + 2) * kWideLanes];
  alignas(64) BlockBits bits[(kSteps + 2) * kWideLanes];
};

/// The same steps as in RayMarker.cpp, with the masks of AVX-512.
struct Walk {
  HOCTOMAP_INLINE_AVX512 static __m512d gather(__m256i rays, const double* from) {
    return _mm512_i32gather_pd(rays, from, sizeof *from);
  }
  HOCTOMAP_INLINE_AVX512 static __m512i gather(__m256i rays, const Code* from) {
    return _mm512_i32gather_epi64(rays, from, sizeof *from);
  }

  HOCTOMAP_INLINE_AVX512 void start(const RayBatch& batch, const std::uint16_t* numbers) {
    const __m256i rays = _mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(numbers)));
    next_x = gather(rays, batch.next[0]);
    next_y = gather(rays, batch.next[1]);
    next_z = gather(rays, batch.next[2]);
    delta_x = gather(rays, batch.delta[0]);
    delta_y = gather(rays, batch.delta[1]);
    delta_z = gather(rays, batch.delta[2]);
    place_x = gather(rays, batch.place[0]);
    place_y = gather(rays, batch.place[1]);
    place_z = gather(rays, batch.place[2]);
    mirror = gather(rays, batch.mirror);
    left = gather(rays, batch.cells);
    margin = gather(rays, batch.margin);
    before = _mm512_set1_pd(-std::numeric_limits<double>::max());
    gap = _mm512_set1_pd(std::numeric_limits<double>::max());
    word = _mm512_srli_epi64(cells(), 6);
    bits = _mm512_setzero_si512();
  }

  HOCTOMAP_INLINE_AVX512 __m512i cells() const {
    return _mm512_xor_si512(_mm512_and_si512(place_x, _mm512_and_si512(place_y, place_z)), mirror);
  }

  HOCTOMAP_INLINE_AVX512 Code longest() const { return _mm512_reduce_max_epi64(left); }

  /// Marks the cells where the lanes stand. @param size of the list
  HOCTOMAP_INLINE_AVX512 void mark(WordList& list, std::size_t& size) {
    const __m512i one = _mm512_set1_epi64(1);
    const __m512i code = cells();
    const __mmask8 live = _mm512_test_epi64_mask(left, left);
    left = _mm512_mask_sub_epi64(left, live, left, one);
    const __m512i here = _mm512_srli_epi64(code, 6);
    const __m512i bit = _mm512_maskz_sllv_epi64(live, one, _mm512_and_si512(code, _mm512_set1_epi64(63)));
    const __mmask8 leaves = _mm512_mask_cmpneq_epi64_mask(live, here, word);
    _mm512_storeu_si512(list.words + size, _mm512_maskz_compress_epi64(leaves, word));
    _mm512_storeu_si512(list.bits + size, _mm512_maskz_compress_epi64(leaves, bits));
    size += static_cast<std::size_t>(_mm_popcnt_u32(leaves));
    word = _mm512_mask_mov_epi64(word, leaves, here);
    bits = _mm512_or_si512(_mm512_mask_mov_epi64(bits, leaves, bit), bit);
  }
  HOCTOMAP_INLINE_AVX512 void markLast(WordList& list, std::size_t& size) const {
    _mm512_storeu_si512(list.words + size, word);
    _mm512_storeu_si512(list.bits + size, bits);
    size += kLanes;
  }

  /// To the next cells.
  HOCTOMAP_INLINE_AVX512 void step() {
    // octomap's order: see nextAxis.
    const __mmask8 x_before_y = _mm512_cmp_pd_mask(next_x, next_y, _CMP_LT_OQ);
    const __mmask8 x_before_z = _mm512_cmp_pd_mask(next_x, next_z, _CMP_LT_OQ);
    const __mmask8 y_before_z = _mm512_cmp_pd_mask(next_y, next_z, _CMP_LT_OQ);
    const __mmask8 x = _kand_mask8(x_before_y, x_before_z);
    const __mmask8 y = _kandn_mask8(x_before_y, y_before_z);
    const __mmask8 z = _kxnor_mask8(x, y);  // x and y are never both set
    const __m512d first = _mm512_min_pd(_mm512_min_pd(next_x, next_y), next_z);
    gap = _mm512_min_pd(gap, _mm512_sub_pd(first, before));
    before = first;
    next_x = _mm512_mask_add_pd(next_x, x, next_x, delta_x);
    next_y = _mm512_mask_add_pd(next_y, y, next_y, delta_y);
    next_z = _mm512_mask_add_pd(next_z, z, next_z, delta_z);
    const __m512i one = _mm512_set1_epi64(1);
    place_x =
        _mm512_or_si512(_mm512_mask_add_epi64(place_x, x, place_x, one), _mm512_set1_epi64(~kAxisPlaces[0]));
    place_y =
        _mm512_or_si512(_mm512_mask_add_epi64(place_y, y, place_y, one), _mm512_set1_epi64(~kAxisPlaces[1]));
    place_z =
        _mm512_or_si512(_mm512_mask_add_epi64(place_z, z, place_z, one), _mm512_set1_epi64(~kAxisPlaces[2]));
  }

  HOCTOMAP_INLINE_AVX512 bool inDoubt() const { return _mm512_cmp_pd_mask(gap, margin, _CMP_LT_OQ) != 0; }

  __m512d next_x, next_y, next_z;
  __m512d delta_x, delta_y, delta_z;
  __m512i place_x, place_y, place_z;
  __m512i mirror;
  __m512i left;  ///< cells
  __m512d margin;
  __m512d gap;
  __m512d before;
  __m512i word;  ///< where the lanes are, and
  __m512i bits;  ///< what they have met of it
};

}  // namespace

HOCTOMAP_TARGET_AVX512 bool markWide(const RayBatch& batch, const std::uint16_t* rays, BlockBits* words,
                                     std::uint8_t* pages) {
  // Two chains of operations that do not depend on each other.
  static_assert(kGroups == 2);
  Walk a;
  Walk b;
  a.start(batch, rays);
  b.start(batch, rays + kLanes);
  const Code longest = std::max(a.longest(), b.longest());
  WordList list;
  for (Code done = 0; done < longest;) {
    std::size_t size = 0;
    const Code stop = std::min(longest, done + static_cast<Code>(kSteps));
    for (; done < stop; ++done) {
      a.mark(list, size);
      b.mark(list, size);
      a.step();
      b.step();
    }
    if (a.inDoubt() || b.inDoubt()) return false;
    if (done == longest) {
      a.markLast(list, size);
      b.markLast(list, size);
    }
    for (std::size_t i = 0; i < size; ++i) {
      words[list.words[i]] |= list.bits[i];
      pages[list.words[i] / kPageWords] = 1;
    }
  }
  return true;
}

}  // namespace hoctomap::engine

#else

namespace hoctomap::engine {

bool markWide(const RayBatch&, const std::uint16_t*, BlockBits*, std::uint8_t*) {
  std::abort();  // no processor of this architecture has the instructions
}

}  // namespace hoctomap::engine

#endif
