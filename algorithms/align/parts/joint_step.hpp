// One Gauss-Newton step of all poses together, for the points of all scans on the lines of all others.
#pragma once

#include <span>
#include <vector>

#include "algorithms/align/parts/line_grid.hpp"
#include "algorithms/align/parts/pose_equations.hpp"
#include "algorithms/align/parts/scan_groups.hpp"

namespace scanbench::align {

/// Number of pairs of a point and a line from which on two scans meet.
inline constexpr int kFewestShared = 5;

struct JointStep {
  Move largest;         ///< largest move of a scan
  double rms_m = 0.0;   ///< weighted residual before the step
  int pairs = 0;        ///< pairs of a point and a line of another scan
  int lowest_rank = 3;  ///< of all scans but the first: the number of their motions that the others determine
  ScanGroups groups{};  ///< joined by at least kFewestShared pairs
};

/// Makes a step towards the minimum of the weighted sum of squared distances between every point of every scan and the
/// nearest line of every other scan. Both poses of a pair move, so there is one sum, and its minimum does not depend on
/// the order of the scans. The first pose is held, and so are the motions of each scan that the others do not
/// determine.
JointStep joint_step(std::span<const ScanShape> scans, const PartnerRules& rules, double longest_m,
                     std::vector<Pose2>& world_from_sensor);

/// How well all points agree with the lines of the other scans: the sum over the same pairs of (1 - (d / gate)^2)^3,
/// which is what Tukey's loss saves against points without partners. It grows with the number of pairs and falls with
/// their distances.
double agreement(std::span<const ScanShape> scans, const PartnerRules& rules, double longest_m,
                 std::span<const Pose2> world_from_sensor);

}  // namespace scanbench::align
