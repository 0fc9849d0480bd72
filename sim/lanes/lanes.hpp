// The vector type of the kernels in sim/lanes/: a few doubles that are processed at once.
//
// Every source file of this folder is compiled three times: for any x86-64 (namespace baseline, two lanes of SSE2), for
// processors with AVX2 (namespace v3, four lanes) and with AVX-512 (namespace v4). There, what concerns boxes and
// walls, of which four belong together, has four lanes too, and what concerns beams has the eight lanes of the types
// that are called wide. Each lane does the same IEEE operations in the same order, so all builds give equal bytes.
// Headers of this folder contain nothing that the linker could merge between the two builds: no standard library, no
// Eigen, only functions of the two namespaces.
#pragma once

#include <immintrin.h>

#ifndef SCANBENCH_ISA
#define SCANBENCH_ISA baseline
#endif

namespace scanbench::sim::SCANBENCH_ISA {

#ifdef __AVX2__
inline constexpr int kLanes = 4;
#else
inline constexpr int kLanes = 2;
#endif
#ifdef __AVX512F__
inline constexpr int kWideLanes = 8;
#else
inline constexpr int kWideLanes = kLanes;
#endif

typedef double Doubles __attribute__((vector_size(8 * kLanes)));            // NOLINT(modernize-use-using)
typedef long long Longs __attribute__((vector_size(8 * kLanes)));           // NOLINT(modernize-use-using)
typedef unsigned long long Words __attribute__((vector_size(8 * kLanes)));  // NOLINT(modernize-use-using)
typedef double LooseDoubles __attribute__((vector_size(8 * kLanes), aligned(8), may_alias));  // NOLINT

typedef double WideDoubles __attribute__((vector_size(8 * kWideLanes)));            // NOLINT(modernize-use-using)
typedef long long WideLongs __attribute__((vector_size(8 * kWideLanes)));           // NOLINT(modernize-use-using)
typedef unsigned long long WideWords __attribute__((vector_size(8 * kWideLanes)));  // NOLINT(modernize-use-using)
typedef double LooseWide __attribute__((vector_size(8 * kWideLanes), aligned(8), may_alias));  // NOLINT

/// The same number in all lanes of Doubles or WideDoubles.
template <class D>
inline D every(double v) {
  return v - D{};
}
inline WideDoubles load_wide(const double* p) {
  return *reinterpret_cast<const LooseWide*>(p);
}
inline void store_wide(double* p, WideDoubles v) {
  *reinterpret_cast<LooseWide*>(p) = v;
}

inline Doubles load(const double* p) {
  return *reinterpret_cast<const LooseDoubles*>(p);
}
inline void store(double* p, Doubles v) {
  *reinterpret_cast<LooseDoubles*>(p) = v;
}
inline Doubles all(double v) {
  return v - Doubles{};
}
inline Longs bits(Doubles v) {
  return reinterpret_cast<Longs>(v);
}
inline Doubles abs(Doubles v) {
  return reinterpret_cast<Doubles>(bits(v) & 0x7fffffffffffffffLL);
}
/// True in lanes where the signs of a and b differ.
inline Longs opposite(Doubles a, Doubles b) {
  return reinterpret_cast<Longs>((reinterpret_cast<Words>(a) ^ reinterpret_cast<Words>(b)) >> 63) != 0;
}

#ifdef __AVX2__
/// The second operand where one is NaN, and for two zeros.
inline Doubles max(Doubles a, Doubles b) {
  return _mm256_max_pd(a, b);
}
inline Doubles min(Doubles a, Doubles b) {
  return _mm256_min_pd(a, b);
}
inline Doubles sqrt(Doubles a) {
  return _mm256_sqrt_pd(a);
}
/// Bit i: the sign bit of lane i.
inline int mask_bits(Longs mask) {
  return _mm256_movemask_pd(reinterpret_cast<Doubles>(mask));
}
/// Products of the low halves of the lanes.
inline Words multiply_low_halves(Words a, Words b) {
  return reinterpret_cast<Words>(_mm256_mul_epu32(reinterpret_cast<__m256i>(a), reinterpret_cast<__m256i>(b)));
}
/// Whole numbers as 32-bit integers.
inline void store_whole(int* p, Doubles v) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(p), _mm256_cvttpd_epi32(v));
}
#else
inline Doubles max(Doubles a, Doubles b) {
  return _mm_max_pd(a, b);
}
inline Doubles min(Doubles a, Doubles b) {
  return _mm_min_pd(a, b);
}
inline Doubles sqrt(Doubles a) {
  return _mm_sqrt_pd(a);
}
inline int mask_bits(Longs mask) {
  return _mm_movemask_pd(reinterpret_cast<Doubles>(mask));
}
inline Words multiply_low_halves(Words a, Words b) {
  return reinterpret_cast<Words>(_mm_mul_epu32(reinterpret_cast<__m128i>(a), reinterpret_cast<__m128i>(b)));
}
inline void store_whole(int* p, Doubles v) {
  _mm_storel_epi64(reinterpret_cast<__m128i*>(p), _mm_cvttpd_epi32(v));
}
#endif

#ifdef __AVX512F__
inline WideDoubles abs(WideDoubles v) {
  return reinterpret_cast<WideDoubles>(reinterpret_cast<WideLongs>(v) & 0x7fffffffffffffffLL);
}
inline WideLongs opposite(WideDoubles a, WideDoubles b) {
  return reinterpret_cast<WideLongs>((reinterpret_cast<WideWords>(a) ^ reinterpret_cast<WideWords>(b)) >> 63) != 0;
}
inline WideDoubles max(WideDoubles a, WideDoubles b) {
  return _mm512_max_pd(a, b);
}
inline WideDoubles min(WideDoubles a, WideDoubles b) {
  return _mm512_min_pd(a, b);
}
inline WideDoubles sqrt(WideDoubles a) {
  return _mm512_sqrt_pd(a);
}
inline int mask_bits(WideLongs mask) {
  return _mm512_movepi64_mask(reinterpret_cast<__m512i>(mask));
}
inline WideWords multiply_low_halves(WideWords a, WideWords b) {
  return reinterpret_cast<WideWords>(_mm512_mul_epu32(reinterpret_cast<__m512i>(a), reinterpret_cast<__m512i>(b)));
}
inline void store_whole(int* p, WideDoubles v) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), _mm512_cvttpd_epi32(v));
}
#endif

}  // namespace scanbench::sim::SCANBENCH_ISA
