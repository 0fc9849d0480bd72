// Computes readings in lanes. Beams without a return are left out of the list of beams and get no random number.
#include "sim/lanes/reading_kernels.hpp"

#include "core/lanes/lanes.hpp"
#include "sim/wall_range.hpp"

namespace scanbench::sim::SCANBENCH_ISA {
namespace {

/// Writes the numbers first, first + 1, ... of the lanes in the mask; returns how many. Writes all lanes' room.
int list_lanes(int mask, int first, std::uint32_t* out) {
  int listed = 0;
  for (int i = 0; i < kLanes; ++i) {
    out[listed] = static_cast<std::uint32_t>(first + i);
    listed += mask >> i & 1;
  }
  return listed;
}

/// The next number of `from` for each lane in the mask; `used` is how many.
Doubles spread(int mask, const double* from, int& used) {
  double lanes[kLanes];
  used = 0;
  for (int i = 0; i < kLanes; ++i) {
    lanes[i] = from[used];
    used += mask >> i & 1;
  }
  return load(lanes);
}

int list_returns(const double* true_ranges, int count, double range_min, double range_max, std::uint32_t* beams) {
  int listed = 0;
  int i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    const Doubles range = load(true_ranges + i);
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
  const Doubles range = load(true_ranges);
  const auto near = all(-kNoHit);
  const auto far = all(kNoHit);
  const Longs too_close = range < noise.range_min_m;
  const Longs returns = (range >= noise.range_min_m) & (range <= noise.range_max_m);
  int used = 0;
  const Doubles read = range + noise.sigma_m * spread(mask_bits(returns), normals, used);
  const Doubles within = read <= noise.range_max_m ? read : far;
  const Doubles reading = ((read < noise.range_min_m) | (read <= 0.0)) ? near : within;
  store(readings, returns ? reading : (too_close ? near : far));
  return used;
}

void observe(const double* true_ranges, int count, const GaussianReading& noise, const double* normals,
             double* readings) {
  int i = 0;
  for (; i + kLanes <= count; i += kLanes) normals += observe_group(true_ranges + i, noise, normals, readings + i);
  if (i == count) return;
  double last[kLanes];
  for (int k = 0; k < kLanes; ++k) last[k] = i + k < count ? true_ranges[i + k] : kNoHit;
  observe_group(last, noise, normals, last);
  for (int k = 0; i + k < count; ++k) readings[i + k] = last[k];
}

}  // namespace

extern const ReadingKernels kReadingKernels;  // NOLINT(readability-redundant-declaration): gives it a name outside
const ReadingKernels kReadingKernels{.list_returns = list_returns, .observe = observe};

}  // namespace scanbench::sim::SCANBENCH_ISA
