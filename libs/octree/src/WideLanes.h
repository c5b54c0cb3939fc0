// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <immintrin.h>

#include "LaneMath.h"

// The types of `Lanes<8>` with AVX-512: GCC 12 takes the comparisons of its vector types apart. To be
// included where that set of instructions is the target.
namespace hoctomap::engine {

struct Mask8 {
  __mmask8 bits = 0;

  HOCTOMAP_INLINE friend Mask8 operator&(Mask8 a, Mask8 b) { return {_kand_mask8(a.bits, b.bits)}; }
  HOCTOMAP_INLINE friend Mask8 operator|(Mask8 a, Mask8 b) { return {_kor_mask8(a.bits, b.bits)}; }
  HOCTOMAP_INLINE friend Mask8 operator~(Mask8 a) { return {_knot_mask8(a.bits)}; }
  HOCTOMAP_INLINE Mask8& operator&=(Mask8 other) { return *this = *this & other; }
  HOCTOMAP_INLINE Mask8& operator|=(Mask8 other) { return *this = *this | other; }
};

struct Floats8 {
  __m256 value;

  Floats8() = default;
  HOCTOMAP_INLINE Floats8(__m256 v) : value(v) {}
  HOCTOMAP_INLINE Floats8(float x) : value(_mm256_set1_ps(x)) {}
  HOCTOMAP_INLINE friend Floats8 operator+(Floats8 a, Floats8 b) { return _mm256_add_ps(a.value, b.value); }
  HOCTOMAP_INLINE friend Floats8 operator-(Floats8 a, Floats8 b) { return _mm256_sub_ps(a.value, b.value); }
  HOCTOMAP_INLINE friend Floats8 operator*(Floats8 a, Floats8 b) { return _mm256_mul_ps(a.value, b.value); }
  HOCTOMAP_INLINE friend Floats8 operator/(Floats8 a, Floats8 b) { return _mm256_div_ps(a.value, b.value); }
};

struct Codes8 {
  __m512i value;

  Codes8() = default;
  HOCTOMAP_INLINE Codes8(__m512i v) : value(v) {}
  HOCTOMAP_INLINE Codes8(Code x) : value(_mm512_set1_epi64(x)) {}
  HOCTOMAP_INLINE friend Codes8 operator+(Codes8 a, Codes8 b) { return _mm512_add_epi64(a.value, b.value); }
  HOCTOMAP_INLINE friend Codes8 operator-(Codes8 a, Codes8 b) { return _mm512_sub_epi64(a.value, b.value); }
  HOCTOMAP_INLINE friend Codes8 operator&(Codes8 a, Codes8 b) { return _mm512_and_si512(a.value, b.value); }
  HOCTOMAP_INLINE friend Codes8 operator|(Codes8 a, Codes8 b) { return _mm512_or_si512(a.value, b.value); }
  HOCTOMAP_INLINE friend Codes8 operator^(Codes8 a, Codes8 b) { return _mm512_xor_si512(a.value, b.value); }
  HOCTOMAP_INLINE friend Codes8 operator<<(Codes8 a, Code places) {
    return _mm512_sll_epi64(a.value, _mm_cvtsi64_si128(places));
  }
  HOCTOMAP_INLINE Codes8& operator|=(Codes8 other) { return *this = *this | other; }
  HOCTOMAP_INLINE friend Mask8 operator==(Codes8 a, Codes8 b) {
    return {_mm512_cmpeq_epi64_mask(a.value, b.value)};
  }
  HOCTOMAP_INLINE friend Mask8 operator!=(Codes8 a, Codes8 b) {
    return {_mm512_cmpneq_epi64_mask(a.value, b.value)};
  }
};

struct Doubles8 {
  __m512d value;

  Doubles8() = default;
  HOCTOMAP_INLINE Doubles8(__m512d v) : value(v) {}
  HOCTOMAP_INLINE Doubles8(double x) : value(_mm512_set1_pd(x)) {}
  HOCTOMAP_INLINE friend Doubles8 operator+(Doubles8 a, Doubles8 b) {
    return _mm512_add_pd(a.value, b.value);
  }
  HOCTOMAP_INLINE friend Doubles8 operator-(Doubles8 a, Doubles8 b) {
    return _mm512_sub_pd(a.value, b.value);
  }
  HOCTOMAP_INLINE friend Doubles8 operator*(Doubles8 a, Doubles8 b) {
    return _mm512_mul_pd(a.value, b.value);
  }
  HOCTOMAP_INLINE friend Doubles8 operator/(Doubles8 a, Doubles8 b) {
    return _mm512_div_pd(a.value, b.value);
  }
  HOCTOMAP_INLINE Doubles8& operator+=(Doubles8 other) { return *this = *this + other; }
  HOCTOMAP_INLINE Doubles8& operator-=(Doubles8 other) { return *this = *this - other; }
  HOCTOMAP_INLINE friend Mask8 operator<(Doubles8 a, Doubles8 b) { return compare<_CMP_LT_OQ>(a, b); }
  HOCTOMAP_INLINE friend Mask8 operator<=(Doubles8 a, Doubles8 b) { return compare<_CMP_LE_OQ>(a, b); }
  HOCTOMAP_INLINE friend Mask8 operator>(Doubles8 a, Doubles8 b) { return compare<_CMP_GT_OQ>(a, b); }
  HOCTOMAP_INLINE friend Mask8 operator>=(Doubles8 a, Doubles8 b) { return compare<_CMP_GE_OQ>(a, b); }
  HOCTOMAP_INLINE friend Mask8 operator==(Doubles8 a, Doubles8 b) { return compare<_CMP_EQ_OQ>(a, b); }
  HOCTOMAP_INLINE friend Mask8 operator!=(Doubles8 a, Doubles8 b) { return compare<_CMP_NEQ_UQ>(a, b); }

 private:
  template <int comparison>
  HOCTOMAP_INLINE static Mask8 compare(Doubles8 a, Doubles8 b) {
    return {_mm512_cmp_pd_mask(a.value, b.value, comparison)};
  }
};

HOCTOMAP_INLINE Doubles8 either(Mask8 mask, Doubles8 a, Doubles8 b) {
  return _mm512_mask_blend_pd(mask.bits, b.value, a.value);
}
HOCTOMAP_INLINE Doubles8 magnitude(Doubles8 a) {
  return _mm512_abs_pd(a.value);
}
HOCTOMAP_INLINE void setFirst(Mask8& mask, std::size_t count) {
  mask.bits = static_cast<__mmask8>(count < 8 ? (1U << count) - 1U : 0xFFU);
}
HOCTOMAP_INLINE bool anyOf(Mask8 mask) {
  return mask.bits != 0;
}
HOCTOMAP_INLINE Codes8 codesOf(Mask8 mask) {
  return _mm512_movm_epi64(mask.bits);
}
HOCTOMAP_INLINE Codes8 toCodes(Doubles8 x) {
  return _mm512_cvttpd_epi64(x.value);
}
HOCTOMAP_INLINE Doubles8 rootOf(Doubles8 x) {
  return _mm512_sqrt_pd(x.value);
}
template <class V>
HOCTOMAP_INLINE V toDoubles(const Floats8& a) {
  return _mm512_cvtps_pd(a.value);
}
template <class F>
HOCTOMAP_INLINE F toFloats(const Doubles8& a) {
  return _mm512_cvtpd_ps(a.value);
}

struct WideLanes {
  using Doubles = Doubles8;
  using Codes = Codes8;
  using Floats = Floats8;
  using Mask = Mask8;
};

}  // namespace hoctomap::engine
