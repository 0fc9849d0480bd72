// Lanes: a few numbers that are processed at once, for the kernels (scanbench_kernels in cmake/targets.cmake).
//
// Kernels are compiled for any x86-64 (namespace baseline) and for processors with AVX2 (namespace v3). Each lane does
// the same IEEE operations in the same order in both, so both give equal bytes. Where lanes are added up, their number
// is part of the result: such kernels fix it. The others take the lanes of a register, `Doubles`.
//
// Only kernels include this folder. Everything in it is inlined and belongs to one of the two namespaces, so that the
// linker never merges code of the two builds. A kernel calls nothing else that is compiled: no standard library, no
// Eigen.
#pragma once

#include <immintrin.h>

#ifndef SCANBENCH_ISA
#define SCANBENCH_ISA baseline
#endif

/// For functions of lanes: the two builds pass wide vectors in different registers, so none is called.
#pragma GCC diagnostic ignored "-Wpsabi"
#define SCANBENCH_INLINE [[gnu::always_inline]] inline

namespace scanbench {
inline namespace SCANBENCH_ISA {

template <class T, int n>
struct LanesOf {
  using type [[gnu::vector_size(sizeof(T) * n)]] = T;
  using loose [[gnu::vector_size(sizeof(T) * n), gnu::aligned(alignof(T)), gnu::may_alias]] = T;  ///< at any address
};

/// n numbers of the type T.
template <class T, int n>
using Lanes = typename LanesOf<T, n>::type;

/// What a comparison of lanes gives: whole numbers of the same size, all bits set where it is true.
template <class V>
using Mask = decltype(V{} < V{});

/// Doubles in a register.
#ifdef __AVX2__
inline constexpr int kLanes = 4;
#else
inline constexpr int kLanes = 2;
#endif
using Doubles = Lanes<double, kLanes>;
using Longs = Mask<Doubles>;
using Words = Lanes<unsigned long long, kLanes>;

template <class V = Doubles, class T>
SCANBENCH_INLINE V load(const T* p) {
  return *reinterpret_cast<const typename LanesOf<T, static_cast<int>(sizeof(V) / sizeof(T))>::loose*>(p);
}
template <class T, class V>
SCANBENCH_INLINE void store(T* p, V v) {
  *reinterpret_cast<typename LanesOf<T, static_cast<int>(sizeof(V) / sizeof(T))>::loose*>(p) = v;
}

/// The same number in all lanes.
template <class V = Doubles, class T>
SCANBENCH_INLINE V all(T number) {
  return number - V{};
}

template <class V>
SCANBENCH_INLINE Mask<V> bits(V v) {
  return reinterpret_cast<Mask<V>>(v);
}

/// `v` where the mask is true, 0 elsewhere.
template <class V>
SCANBENCH_INLINE V masked(Mask<V> mask, V v) {
  return reinterpret_cast<V>(bits(v) & mask);
}

/// By bits: also fast for more lanes than a register has.
template <class V>
SCANBENCH_INLINE V select(Mask<V> mask, V yes, V no) {
  return reinterpret_cast<V>((bits(yes) & mask) | (bits(no) & ~mask));
}

template <class V>
SCANBENCH_INLINE V abs(V v) {
  return reinterpret_cast<V>(bits(v) & ~bits(-V{}));
}

/// True in the first `count` lanes of V.
template <class V>
SCANBENCH_INLINE Mask<V> first_lanes(int count) {
  Mask<V> lane{};
  for (int i = 0; i < static_cast<int>(sizeof(V) / sizeof(lane[0])); ++i) lane[i] = i;
  return lane < all<Mask<V>>(static_cast<decltype(lane[0] + lane[0])>(count));
}

/// Sum of four or eight lanes, in pairs half a vector apart.
template <class V>
SCANBENCH_INLINE auto total(V v) {
  if constexpr (sizeof(V) == 4 * sizeof(v[0]))
    return (v[0] + v[2]) + (v[1] + v[3]);
  else
    return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

/// True in lanes where the signs of a and b differ.
SCANBENCH_INLINE Longs opposite(Doubles a, Doubles b) {
  return reinterpret_cast<Longs>((reinterpret_cast<Words>(a) ^ reinterpret_cast<Words>(b)) >> 63) != 0;
}

#ifdef __AVX2__
/// The second operand where one is NaN, and for two zeros.
SCANBENCH_INLINE Doubles max(Doubles a, Doubles b) {
  return _mm256_max_pd(a, b);
}
SCANBENCH_INLINE Doubles min(Doubles a, Doubles b) {
  return _mm256_min_pd(a, b);
}
SCANBENCH_INLINE Doubles sqrt(Doubles a) {
  return _mm256_sqrt_pd(a);
}
/// Bit i: the sign bit of lane i.
SCANBENCH_INLINE int mask_bits(Longs mask) {
  return _mm256_movemask_pd(reinterpret_cast<Doubles>(mask));
}
/// Products of the low halves of the lanes.
SCANBENCH_INLINE Words multiply_low_halves(Words a, Words b) {
  return reinterpret_cast<Words>(_mm256_mul_epu32(reinterpret_cast<__m256i>(a), reinterpret_cast<__m256i>(b)));
}
/// Whole numbers as 32-bit integers.
SCANBENCH_INLINE void store_whole(int* p, Doubles v) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(p), _mm256_cvttpd_epi32(v));
}
#else
SCANBENCH_INLINE Doubles max(Doubles a, Doubles b) {
  return _mm_max_pd(a, b);
}
SCANBENCH_INLINE Doubles min(Doubles a, Doubles b) {
  return _mm_min_pd(a, b);
}
SCANBENCH_INLINE Doubles sqrt(Doubles a) {
  return _mm_sqrt_pd(a);
}
SCANBENCH_INLINE int mask_bits(Longs mask) {
  return _mm_movemask_pd(reinterpret_cast<Doubles>(mask));
}
SCANBENCH_INLINE Words multiply_low_halves(Words a, Words b) {
  return reinterpret_cast<Words>(_mm_mul_epu32(reinterpret_cast<__m128i>(a), reinterpret_cast<__m128i>(b)));
}
SCANBENCH_INLINE void store_whole(int* p, Doubles v) {
  _mm_storel_epi64(reinterpret_cast<__m128i*>(p), _mm_cvttpd_epi32(v));
}
#endif

}  // namespace SCANBENCH_ISA
}  // namespace scanbench
