// Registers one scan on fixed lines by the segment-point method, Siadat et al. 1997, section 7.
#pragma once

#include <algorithm>
#include <cmath>

#include "algorithms/align/parts/line_grid.hpp"
#include "algorithms/align/parts/pose_equations.hpp"

namespace scanbench::align {

/// The gate of each iteration: `wide_m`, halved at each iteration, down to `narrow_m`.
struct Gates {
  double wide_m;
  double narrow_m;
  double at(int iteration) const { return std::max(std::ldexp(wide_m, -iteration), narrow_m); }
  bool narrow(int iteration) const { return at(iteration) <= narrow_m; }
};

/// Gauss-Newton on n . (R p + t) + c, where each point has its nearest line of each scan in the grid. Ends when a step
/// is small or after 20 iterations. The pose does not move along directions that the pairs do not determine; without
/// partners it stays. The gate of `rules` is ignored.
Pose2 register_scan(const ScanShape& scan, const LineGrid& lines, const Pose2& predicted, PartnerRules rules,
                    const Gates& gates);

}  // namespace scanbench::align
