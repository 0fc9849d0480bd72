// The pose of a scan by an oracle that knows which beams see which surface.
#pragma once

#include <optional>

#include "core/match.hpp"
#include "metrics/line_matching.hpp"

namespace scanbench::accuracy {

/// Maximum likelihood of the pose of `frame` in the frame of `reference` from the readings of both scans on the
/// surfaces that both see, whose places are unknown. It is told which beams end on which surface and starts from the
/// truth. Surfaces with fewer than `least_returns` returns in either scan are left out. Covariance: inverse of the
/// Fisher information. Absent if the readings do not determine the pose. The input must satisfy has_beam_truth().
std::optional<Match> oracle_match(const metrics::MetricInput& input, const metrics::Surfaces& surfaces,
                                  std::size_t reference, std::size_t frame, int least_returns = 1);

}  // namespace scanbench::accuracy
