// One Gauss-Newton step of all poses together, each scan against the lines of all others.
#pragma once

#include <span>
#include <vector>

#include "algorithms/align/point_to_line/line_grid.hpp"
#include "algorithms/align/point_to_line/pose_equations.hpp"

namespace scanbench::align {

struct JointStep {
  Move largest;         ///< largest shift and largest rotation of a scan
  double rms_m = 0.0;   ///< weighted residual before the step
  int pairs = 0;        ///< number of pairs of a point and a line of another scan
  int lowest_rank = 3;  ///< smallest number of motions of a scan, but the first, that the others determine
};

/// A step towards the minimum of the weighted sum of squared distances between every point of every scan and the
/// nearest line of every other scan. Both poses of a pair move, so all scans minimise the same sum, independent of
/// their order. The first pose is held, and so are the motions of a scan that the others do not determine.
JointStep joint_step(std::span<const ScanShape> scans, const PartnerRules& rules, double longest_m,
                     std::vector<Pose2>& world_from_sensor);

}  // namespace scanbench::align
