// One-to-one matching of the lines found in a scan with its true lines: what `segments` and `efficiency` count.
#pragma once

#include <span>
#include <vector>

#include "core/scan.hpp"
#include "metrics/true_lines.hpp"

namespace scanbench::metrics {

struct MatchRule {
  double max_angle_rad = radians(10.0);
  double max_offset_m = 0.15;  ///< of the found line's midpoint from the true line
  double min_overlap = 0.5;    ///< share of the shorter of the two, exceeded by the overlap of the projections
  double min_length_m = 0.5;   ///< a shorter line that matches nothing is passed over
};

/// How a found line compares with a true line, along the true line's direction.
struct Overlap {
  double length_m = 0.0;   ///< of the common part of the projections
  double union_m = 0.0;    ///< extent of both together where they overlap
  double offset_m = 0.0;   ///< signed distance of the found line's midpoint from the true line
  double angle_rad = 0.0;  ///< undirected, in (-pi/2, pi/2]
};
Overlap overlap(const Segment& found, const Segment& truth);

enum class Outcome { true_line, split, false_line, ignored };

/// Per found line its outcome and, for true ones, the index of its true line (else -1).
struct LineMatching {
  std::vector<Outcome> outcome;
  std::vector<int> truth;
  std::vector<bool> merged;  ///< matches true lines of two surfaces, each over more than half of their length
};

/// Pairs that satisfy the rule are taken by decreasing overlap while both are free (ties: lower indices first). A line
/// left over is split if it satisfies the rule with some true line, else false.
LineMatching match_lines(std::span<const LineFeature> found, std::span<const TrueLine> truth, const MatchRule& rule);

}  // namespace scanbench::metrics
