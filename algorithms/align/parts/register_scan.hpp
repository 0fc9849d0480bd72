// One scan against lines that stand: segment-point registration, Siadat et al. 1997, section 7.
#pragma once

#include <algorithm>
#include <cmath>

#include "algorithms/align/parts/line_grid.hpp"
#include "algorithms/align/parts/pose_equations.hpp"

namespace scanbench::align {

/// `wide_m`, halved at each iteration, down to `narrow_m`.
struct Gates {
  double wide_m;
  double narrow_m;
  double at(int iteration) const { return std::max(std::ldexp(wide_m, -iteration), narrow_m); }
  bool narrow(int iteration) const { return at(iteration) <= narrow_m; }
};

/// Gauss-Newton on n . (R p + t) + c, each point with its nearest line of each scan in the grid, until a step is small
/// or 20 are done. No motion along what these do not determine: without partners the pose stays.
/// Of `rules` the gate does not count.
Pose2 register_scan(const ScanShape& scan, const LineGrid& lines, const Pose2& predicted, PartnerRules rules,
                    const Gates& gates);

}  // namespace scanbench::align
