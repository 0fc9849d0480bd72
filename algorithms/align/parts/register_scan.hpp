// Registration of one scan on fixed lines: the segment-point method of Siadat et al. 1997, section 7.
#pragma once

#include <algorithm>
#include <cmath>

#include "algorithms/align/parts/line_grid.hpp"
#include "algorithms/align/parts/pose_equations.hpp"

namespace scanbench::align {

/// The gate per iteration: `wide_m`, halved at each iteration, down to `narrow_m`.
struct Gates {
  double wide_m;
  double narrow_m;
  double at(int iteration) const { return std::max(std::ldexp(wide_m, -iteration), narrow_m); }
  bool is_narrowest(int iteration) const { return at(iteration) <= narrow_m; }
};

/// Gauss-Newton on n . (R p + t) + c, for each point and its nearest line of each scan in the grid, until a step is
/// negligible, at most 20 steps. The pose does not move in directions that the lines do not determine; without partners
/// it stays. The gate of `rules` is ignored.
Pose2 register_scan(const ScanShape& scan, const LineGrid& lines, const Pose2& predicted, PartnerRules rules,
                    const Gates& gates);

}  // namespace scanbench::align
