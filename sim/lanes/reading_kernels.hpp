// Readings of whole scans whose noise is a gaussian error alone, in lanes.
#pragma once

#include <cstdint>

namespace scanbench::sim {

/// Noise of one constant standard deviation > 0, without drop-outs, short returns and rounding.
struct GaussianReading {
  double range_min_m;
  double range_max_m;
  double sigma_m;
};

/// The kernels of readings, for one kind of processor.
struct ReadingKernels {
  /// Lists the beams with a range within [range_min, range_max], in their order, and returns their number. `beams` has
  /// room for 8 more than `count`.
  int (*list_returns)(const double* true_ranges, int count, double range_min_m, double range_max_m,
                      std::uint32_t* beams);
  /// observed_range() of sim/noise.hpp, bit for bit, of `count` beams. `normals`: one for each listed beam, and room
  /// for 8 more.
  void (*observe)(const double* true_ranges, int count, const GaussianReading& noise, const double* normals,
                  double* readings);
};

namespace baseline {
extern const ReadingKernels kReadingKernels;
}
namespace v3 {
extern const ReadingKernels kReadingKernels;
}

}  // namespace scanbench::sim
