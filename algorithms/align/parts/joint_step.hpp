// All scans against the lines of all others: one Gauss-Newton step of all poses together.
#pragma once

#include <span>
#include <vector>

#include "algorithms/align/parts/line_grid.hpp"
#include "algorithms/align/parts/pose_equations.hpp"
#include "algorithms/align/parts/scan_groups.hpp"

namespace scanbench::align {

/// Pairs of a point and a line that make two scans meet.
inline constexpr int kFewestShared = 5;

struct JointStep {
  Move largest;         ///< of the scans' moves
  double rms_m = 0.0;   ///< weighted residual before the step
  int pairs = 0;        ///< of a point and a line of another scan
  int lowest_rank = 3;  ///< of the scans but the first: how many of their motions the others determine
  ScanGroups groups{};  ///< joined by at least kFewestShared pairs
};

/// Towards the minimum of the weighted sum of squared distances between every point of every scan and the nearest line
/// of every other scan. Both poses of a pair move, so there is one sum, and its minimum does not depend on who is asked
/// first. The first pose is held; so is, of each scan, what the others do not determine.
JointStep joint_step(std::span<const ScanShape> scans, const PartnerRules& rules, double longest_m,
                     std::vector<Pose2>& world_from_sensor);

}  // namespace scanbench::align
