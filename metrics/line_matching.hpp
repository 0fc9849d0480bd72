// One-to-one matching of the lines found in a scan with its true lines, for `segments` and `efficiency`.
#pragma once

#include <span>
#include <vector>

#include "core/scan.hpp"
#include "metrics/walls/true_lines.hpp"

namespace scanbench::metrics {

struct MatchRule {
  double max_angle_rad = radians(10.0);
  double max_offset_m = 0.15;  ///< of the found line's midpoint from the true line
  double min_overlap = 0.5;    ///< the overlap of the projections must exceed this share of the shorter one
  double min_length_m = 0.5;   ///< a shorter line that matches nothing is ignored
};

/// How a found line compares with a true line, along the true line's direction.
struct Overlap {
  double length_m = 0.0;   ///< of the common part of the projections
  double union_m = 0.0;    ///< extent of both together where they overlap
  double offset_m = 0.0;   ///< signed distance of the found line's midpoint from the true line
  double angle_rad = 0.0;  ///< undirected, in (-pi/2, pi/2]
};
Overlap overlap(const Segment& found, const Segment& truth);

enum class Outcome {
  true_line,
  split,
  false_line,
  too_small,  ///< right, but on a wall too small to be a true line; match_lines() does not give it, judge_scan() does
  ignored
};

/// Per found line its outcome and, for a true_line, the index of its true line (else -1).
struct LineMatching {
  std::vector<Outcome> outcome;
  std::vector<int> truth;
  std::vector<bool> merged;  ///< covers more than half of the length of true lines of two surfaces
};

/// Takes the pairs that satisfy the rule by decreasing overlap, each line at most once (ties: lower indices first). A
/// found line that remains is `split` if it satisfies the rule with some true line; else it is `false_line`, or
/// `ignored` if it is short.
LineMatching match_lines(std::span<const LineFeature> found, std::span<const TrueLine> truth, const MatchRule& rule);

}  // namespace scanbench::metrics
