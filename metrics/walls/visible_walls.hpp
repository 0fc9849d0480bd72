// The parts of the walls that the scans of a run show.
#pragma once

#include <vector>

#include "core/geometry/interval.hpp"
#include "metrics/metric.hpp"
#include "metrics/walls/surfaces.hpp"

namespace scanbench::metrics {

/// True if the truth has walls and, unless the run has lines only, knows the wall of each beam.
bool knows_walls(const MetricInput& input);

/// The visible parts of every surface, in metres from its first end: where at least `hits_per_m` returns per metre came
/// from over the whole run, in bins of 10 cm. In a run of lines without scans every part is visible. The input must
/// satisfy knows_walls().
std::vector<std::vector<Interval>> visible_parts(const MetricInput& input, const Surfaces& surfaces, double hits_per_m);

}  // namespace scanbench::metrics
