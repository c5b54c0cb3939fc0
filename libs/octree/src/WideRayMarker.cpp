// SPDX-License-Identifier: BSD-3-Clause
#include "WideRayMarker.h"

#include <cstdlib>

#if defined(__x86_64__)

#include <immintrin.h>

#include "LaneMath.h"

namespace hoctomap::engine {

namespace {

HOCTOMAP_TARGET_AVX512 inline __m512d gather(__m256i rays, const double* from) {
  return _mm512_i32gather_pd(rays, from, sizeof *from);
}
HOCTOMAP_TARGET_AVX512 inline __m512i gather(__m256i rays, const Code* from) {
  return _mm512_i32gather_epi64(rays, from, sizeof *from);
}
HOCTOMAP_TARGET_AVX512 inline __m512i cellsAt(__m512i x, __m512i y, __m512i z, __m512i mirror) {
  return _mm512_xor_si512(_mm512_and_si512(x, _mm512_and_si512(y, z)), mirror);
}

}  // namespace

// The same steps as in RayMarker.cpp, with the masks of AVX-512.
HOCTOMAP_TARGET_AVX512 bool markWide(const RayBatch& batch, const std::uint16_t* rays, BlockBits* words,
                                     std::uint8_t* pages) {
  const __m256i index = _mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(rays)));
  __m512d next_x = gather(index, batch.next[0]);
  __m512d next_y = gather(index, batch.next[1]);
  __m512d next_z = gather(index, batch.next[2]);
  const __m512d delta_x = gather(index, batch.delta[0]);
  const __m512d delta_y = gather(index, batch.delta[1]);
  const __m512d delta_z = gather(index, batch.delta[2]);
  __m512i place_x = gather(index, batch.place[0]);
  __m512i place_y = gather(index, batch.place[1]);
  __m512i place_z = gather(index, batch.place[2]);
  const __m512i mirror = gather(index, batch.mirror);
  const __m512i cells = gather(index, batch.cells);
  const __m512d margin = gather(index, batch.margin);
  const __m512i others_x = _mm512_set1_epi64(~kAxisPlaces[0]);
  const __m512i others_y = _mm512_set1_epi64(~kAxisPlaces[1]);
  const __m512i others_z = _mm512_set1_epi64(~kAxisPlaces[2]);
  const __m512i one = _mm512_set1_epi64(1);
  __m512d before = _mm512_set1_pd(-std::numeric_limits<double>::max());
  __m512d gap = _mm512_set1_pd(std::numeric_limits<double>::max());
  // Words and the bits to be set in them, from all lanes, in the order in which they come.
  constexpr std::size_t kSteps = 64;
  alignas(64) std::uint64_t list_words[(kSteps + 2) * kWideLanes];
  alignas(64) BlockBits list_bits[(kSteps + 2) * kWideLanes];
  std::size_t size = 0;
  __m512i word = _mm512_srli_epi64(cellsAt(place_x, place_y, place_z, mirror), 6);
  __m512i bits = _mm512_setzero_si512();
  const Code longest = _mm512_reduce_max_epi64(cells);
  __m512i left = cells;
  for (Code done = 0; done < longest;) {
    const Code stop = std::min(longest, done + static_cast<Code>(kSteps));
    for (; done < stop; ++done) {
      const __m512i code = cellsAt(place_x, place_y, place_z, mirror);
      const __mmask8 live = _mm512_test_epi64_mask(left, left);
      left = _mm512_mask_sub_epi64(left, live, left, one);
      const __m512i here = _mm512_srli_epi64(code, 6);
      const __m512i bit = _mm512_maskz_sllv_epi64(live, one, _mm512_and_si512(code, _mm512_set1_epi64(63)));
      const __mmask8 leaves = _mm512_mask_cmpneq_epi64_mask(live, here, word);
      _mm512_storeu_si512(list_words + size, _mm512_maskz_compress_epi64(leaves, word));
      _mm512_storeu_si512(list_bits + size, _mm512_maskz_compress_epi64(leaves, bits));
      size += static_cast<std::size_t>(_mm_popcnt_u32(leaves));
      word = _mm512_mask_mov_epi64(word, leaves, here);
      bits = _mm512_or_si512(_mm512_mask_mov_epi64(bits, leaves, bit), bit);

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
      place_x = _mm512_or_si512(_mm512_mask_add_epi64(place_x, x, place_x, one), others_x);
      place_y = _mm512_or_si512(_mm512_mask_add_epi64(place_y, y, place_y, one), others_y);
      place_z = _mm512_or_si512(_mm512_mask_add_epi64(place_z, z, place_z, one), others_z);
    }
    if (_mm512_cmp_pd_mask(gap, margin, _CMP_LT_OQ) != 0) return false;
    if (done == longest) {
      _mm512_storeu_si512(list_words + size, word);
      _mm512_storeu_si512(list_bits + size, bits);
      size += kWideLanes;
    }
    for (std::size_t i = 0; i < size; ++i) {
      words[list_words[i]] |= list_bits[i];
      pages[list_words[i] / kPageWords] = 1;
    }
    size = 0;
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
