// Returns on walls of which their own scan shows too little for a line, and the other scan a line.
// docs/algorithms/scan_matching.md, section 3.
#pragma once

#include <span>
#include <vector>

#include "algorithms/match/optimal/scan_lines.hpp"
#include "algorithms/match/optimal/wall_pairs.hpp"
#include "algorithms/match/parts/pose_information.hpp"

namespace scanbench::matching {

/// The lines and returns of both scans that are in no pair of walls.
struct Remainder {
  std::vector<MeasuredLine> reference_lines;
  std::vector<MeasuredLine> current_lines;
  std::span<const LoneReturn> reference_returns;
  std::span<const LoneReturn> current_returns;
};
Remainder remainder(std::span<const WallPair> walls, const ScanMeasurements& reference,
                    const ScanMeasurements& current);

/// Adds the equations of returns on lines of the other scan: one coordinate each, across the line. Its variance is the
/// sum of those of the return and of the line there. A return is assigned to the line from which it differs least, if
/// belief and covariances allow the difference and it is between the line's ends. `doubt` as for wall_equations().
void add_lone_returns(const Remainder& rest, const PoseBelief& belief, const PoseDoubt& doubt, WallEquations& sum);

}  // namespace scanbench::matching
