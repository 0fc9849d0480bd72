// The lines that an extractor should find in a scan: what the scan shows of each surface in one piece.
#pragma once

#include <vector>

#include "metrics/metric.hpp"
#include "metrics/walls/surfaces.hpp"

namespace scanbench::metrics {

/// What a scan shows of a surface in one piece, sensor frame.
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

}  // namespace scanbench::metrics
