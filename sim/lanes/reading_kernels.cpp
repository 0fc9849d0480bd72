// Computes readings in lanes. Beams without a return are left out of the list of beams and get no random number.
#include "sim/lanes/reading_kernels.hpp"

#include "sim/lanes/lanes.hpp"
#include "sim/wall_range.hpp"

namespace scanbench::sim::SCANBENCH_ISA {
namespace {

#ifdef __AVX512F__
/// Writes the numbers first, first + 1, ... of the lanes in the mask; returns how many. Writes all lanes' room.
int list_lanes(int mask, int first, std::uint32_t* out) {
  const __m256i numbers = _mm256_add_epi32(_mm256_set1_epi32(first), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(out),
                      _mm256_maskz_compress_epi32(static_cast<__mmask8>(mask), numbers));
  return _mm_popcnt_u32(static_cast<unsigned>(mask));
}

/// The next number of `from` for each lane in the mask, 0 in the others; `used` is how many.
WideDoubles spread(int mask, const double* from, int& used) {
  used = _mm_popcnt_u32(static_cast<unsigned>(mask));
  return _mm512_maskz_expand_pd(static_cast<__mmask8>(mask), load_wide(from));
}
#else
int list_lanes(int mask, int first, std::uint32_t* out) {
  int listed = 0;
  for (int i = 0; i < kWideLanes; ++i) {
    out[listed] = static_cast<std::uint32_t>(first + i);
    listed += mask >> i & 1;
  }
  return listed;
}

WideDoubles spread(int mask, const double* from, int& used) {
  double lanes[kWideLanes];
  used = 0;
  for (int i = 0; i < kWideLanes; ++i) {
    lanes[i] = from[used];
    used += mask >> i & 1;
  }
  return load_wide(lanes);
}
#endif

int list_returns(const double* true_ranges, int count, double range_min, double range_max, std::uint32_t* beams) {
  int listed = 0;
  int i = 0;
  for (; i + kWideLanes <= count; i += kWideLanes) {
    const WideDoubles range = load_wide(true_ranges + i);
    listed += list_lanes(mask_bits((range >= range_min) & (range <= range_max)), i, beams + listed);
  }
  for (; i < count; ++i) {
    beams[listed] = static_cast<std::uint32_t>(i);
    listed += true_ranges[i] >= range_min && true_ranges[i] <= range_max ? 1 : 0;
  }
  return listed;
}

/// The readings of one group of beams; returns the number of normals that it uses.
int observe_group(const double* true_ranges, const GaussianReading& noise, const double* normals, double* readings) {
  const WideDoubles range = load_wide(true_ranges);
  const auto near = every<WideDoubles>(-kNoHit);
  const auto far = every<WideDoubles>(kNoHit);
  const WideLongs too_close = range < noise.range_min_m;
  const WideLongs returns = (range >= noise.range_min_m) & (range <= noise.range_max_m);
  int used = 0;
  const WideDoubles read = range + noise.sigma_m * spread(mask_bits(returns), normals, used);
  const WideDoubles within = read <= noise.range_max_m ? read : far;
  const WideDoubles reading = ((read < noise.range_min_m) | (read <= 0.0)) ? near : within;
  store_wide(readings, returns ? reading : (too_close ? near : far));
  return used;
}

void observe(const double* true_ranges, int count, const GaussianReading& noise, const double* normals,
             double* readings) {
  int i = 0;
  for (; i + kWideLanes <= count; i += kWideLanes)
    normals += observe_group(true_ranges + i, noise, normals, readings + i);
  if (i == count) return;
  double last[kWideLanes];
  for (int k = 0; k < kWideLanes; ++k) last[k] = i + k < count ? true_ranges[i + k] : kNoHit;
  observe_group(last, noise, normals, last);
  for (int k = 0; i + k < count; ++k) readings[i + k] = last[k];
}

}  // namespace

extern const ReadingKernels kReadingKernels;  // NOLINT(readability-redundant-declaration): gives it a name outside
const ReadingKernels kReadingKernels{.list_returns = list_returns, .observe = observe};

}  // namespace scanbench::sim::SCANBENCH_ISA
