// Common parts of the aligners that solve for all poses at once: the gate for partners, and the status and message of
// the result.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "algorithms/align/parts/pose_equations.hpp"
#include "algorithms/align/parts/scan_groups.hpp"
#include "core/modules.hpp"

namespace scanbench::align {

/// Standard deviations of the given poses: of the position on each axis, and of the heading.
struct OdometryError {
  double sigma_m;
  double sigma_rad;
};

/// The distance at which two scans may place one surface: 2.5 standard deviations of the difference of two poses, at
/// the median of the levers (typical distances of the returns of a scan) [m]. Without levers the lever is 0.
double gate_for(const OdometryError& error, std::span<const double> levers_m);

/// A movement for a message: one significant digit, so that messages of many runs can be counted together.
std::string movement_text(double value);

/// How the last round of a joint solution went.
struct Outcome {
  ScanGroups groups;
  bool slides = false;  ///< a scan has motions that the others do not determine
  bool converged = false;
  int rounds = 0;
  Move last;
};

/// The status is no_match, with the poses as given, if no two scans meet; degenerate if groups of scans do not meet or
/// a scan can slide; max_iterations if the last round still moved poses. The first pose keeps its given place.
Alignment judged(const Outcome& outcome, std::span<const Pose2> initial, std::span<const Pose2> poses);

}  // namespace scanbench::align
