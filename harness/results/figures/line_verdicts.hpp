// Verdicts of the truth on the lines of a result, for figures.
#pragma once

#include <vector>

#include "core/recording.hpp"
#include "core/result.hpp"
#include "harness/study/catalog/pipeline_spec.hpp"
#include "metrics/judged_scan.hpp"
#include "render/figure.hpp"

namespace scanbench::results {

/// The verdicts of each frame, by the rules of the metric family `segments` with these parameters; empty without the
/// truth of each beam.
std::vector<render::ScanVerdict> line_verdicts(const Recording& recording, const PipelineResult& result,
                                               const metrics::SegmentRules& rules = {});

/// The parameters of `segments` in a scenario's list of metrics; the default ones if it is not in the list.
metrics::SegmentRules segment_rules(const std::vector<study::ModuleChoice>& families);

}  // namespace scanbench::results
