// The beams of one scan as plain numbers and pointers, for the kernels of sim/lanes/.
#pragma once

#include <cstdint>

namespace scanbench::sim {

/// Beams from one origin, sorted by angle: beam i points within `slack_rad` of start_rad + i * step_rad, world frame.
/// Arrays have `padded` elements, a multiple of 8; those after the last beam are copies of it.
struct BeamFan {
  double origin_x;
  double origin_y;
  const double* dx;  ///< unit directions, world frame
  const double* dy;
  int beams;
  int padded;
  double start_rad;  ///< in [-pi, pi]
  double step_rad;   ///< not 0; |step| * (beams - 1) < 2 pi
  double slack_rad;
};

/// The nearest surface of each beam so far. Initially none (-1), at range unhit_range().
struct BeamHits {
  double* range;
  double* surface;  ///< index of the surface; -1: none
};

/// The range of a beam without a hit: beyond `range_max_m` by more than rounding errors and the width of a tie, so that
/// a surface at the maximum still counts.
[[gnu::always_inline]] inline double unhit_range(double range_max_m) {
  return range_max_m * (1 + 1e-12) + 2e-9;
}

/// A run of consecutive beams, both ends included; empty if last < first.
struct BeamRun {
  int first;
  int last;
};

/// The beams with numbers in [from, from + width], modulo a full turn of `period` beams: up to two runs. `from` must be
/// within one period of 0.
struct BeamRuns {
  BeamRun runs[2];
};

[[gnu::always_inline]] inline BeamRuns beam_runs(double from, double width, double period, int beams) {
  const BeamRun none{0, -1};
  if (!(width < period)) return {{{0, beams - 1}, none}};
  if (from < 0) from += period;
  if (from < 0) from += period;
  const double to = from + width;
  int first = static_cast<int>(from);
  first += first < from ? 1 : 0;
  const int last = to < beams - 1 ? static_cast<int>(to) : beams - 1;
  if (to < period) return {{{first, last}, none}};
  const double behind = to - period;
  return {{{first, last}, {0, behind < beams - 1 ? static_cast<int>(behind) : beams - 1}}};
}

}  // namespace scanbench::sim
