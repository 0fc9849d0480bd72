// The vector type of the kernels in sim/lanes/: a few doubles that are processed at once.
//
// Every source file of this folder is compiled twice: for any x86-64 (namespace baseline, two lanes of SSE2) and for
// processors with AVX2 (namespace v3, four lanes). Each lane does the same IEEE operations in the same order, so both
// give equal bytes. Headers of this folder contain nothing that the linker could merge between the two builds: no
// standard library, no Eigen, only functions of the two namespaces.
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

typedef double Doubles __attribute__((vector_size(8 * kLanes)));            // NOLINT(modernize-use-using)
typedef long long Longs __attribute__((vector_size(8 * kLanes)));           // NOLINT(modernize-use-using)
typedef unsigned long long Words __attribute__((vector_size(8 * kLanes)));  // NOLINT(modernize-use-using)
typedef double LooseDoubles __attribute__((vector_size(8 * kLanes), aligned(8), may_alias));  // NOLINT

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

}  // namespace scanbench::sim::SCANBENCH_ISA
