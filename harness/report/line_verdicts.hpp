// Verdicts of the truth on the lines of a result, for figures.
#pragma once

#include <vector>

#include "core/recording.hpp"
#include "core/result.hpp"
#include "render/figure.hpp"

namespace scanbench::harness {

/// The verdicts of each frame, by the rules of the metric family `segments` with its default parameters; empty without
/// the truth of each beam.
std::vector<render::ScanVerdict> line_verdicts(const Recording& recording, const PipelineResult& result);

}  // namespace scanbench::harness
