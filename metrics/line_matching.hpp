// True lines of a scan and their one-to-one matching with the lines found in it: what `segments` and `efficiency`
// count.
#pragma once

#include <span>
#include <vector>

#include "metrics/metric.hpp"

namespace scanbench::metrics {

/// Walls that lie on one line and touch or overlap are one surface: no sensor can tell where one ends. Collinear walls
/// with a gap between them stay two.
struct Surfaces {
  std::vector<Segment> segments;  ///< hull of its walls, in the order of their first walls
  std::vector<int> of_wall;       ///< per wall the index of its surface
};
Surfaces join_walls(std::span<const Wall> walls);

/// What of a wall a scan shows in one piece, sensor frame.
struct TrueLine {
  Segment segment;  ///< from the exact point of the first beam to that of the last
  int surface = -1;
  int first_beam = -1;
  int last_beam = -1;  ///< inclusive; beams between them without a return were lost, not blocked
  int beams = 0;       ///< with a return
};

struct TrueLineRule {
  int min_beams = 9;          ///< returns
  double min_length_m = 0.5;  ///< between the outer ones
};

/// Maximal runs of beams of one frame that end on one surface, in beam order. A lost return does not end a run, another
/// surface or a body in front of the wall does. The input must satisfy has_beam_truth().
std::vector<TrueLine> true_lines(const MetricInput& input, std::size_t frame, const Surfaces& surfaces,
                                 const TrueLineRule& rule);

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

enum class Outcome { true_line, split, false_line, passed_over };

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
