// Non-blurring Gaussian mean shift of a whole point set to the modes of its density (Lakaemper 2009, section III,
// eq. 1; Cheng 1995).
#pragma once

#include <span>
#include <vector>

#include "algorithms/merge/parts/point_grid.hpp"

namespace scanbench::merge {

/// Lengths in standard deviations of the kernel exp(-|d|^2 / 2).
struct ModeOptions {
  double cutoff = 4.0;      ///< cut-off of the kernel while climbing; modes are polished with 6.5
  double period = 0.0;      ///< period of the third coordinate; 0: none, otherwise at least min_period(cutoff)
  double tolerance = 1e-3;  ///< tolerance of climbs by eq. 1 alone, before the polish
  int max_steps = 5000;     ///< mean-shift steps of one climb
  bool accelerate = true;   ///< Newton steps where shifts are short
  bool capture = true;      ///< end a climb as soon as it is near a known mode
};

/// The smallest period at which no point is within the cut-off on both sides, where the distance of eq. 4 has a kink.
double min_period(double cutoff);

struct Modes {
  std::vector<Vec3> positions;  ///< gradient zero to 1e-6 unless `converged` is false; third coordinate in [0, period)
  std::vector<int> mode_of;     ///< per point
  bool converged = true;        ///< every mode reached the gradient goal and no climb ran out of steps
};

/// The modes to which the points climb in the density of all points. Coordinates are finite, in standard deviations,
/// below 1e9; the third is in [0, period) if the period is not 0. No points: no modes. The result depends on the
/// sequence of the points (sort them to be independent of their order). `paths`, if given, receives every point's
/// trajectory, from the point itself to its mode; equal points have the trajectory of the first of them.
Modes find_modes(std::span<const Vec3> points, const ModeOptions& options,
                 std::vector<std::vector<Vec3>>* paths = nullptr);

}  // namespace scanbench::merge
