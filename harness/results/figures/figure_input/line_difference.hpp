// The comparison of found lines with true walls as pixels, for figures.
#pragma once

#include <optional>

#include "core/recording.hpp"
#include "core/result.hpp"
#include "harness/study/catalog/pipeline_spec.hpp"
#include "metrics/raster/raster_comparison.hpp"
#include "render/figure.hpp"

namespace scanbench::results {

/// The parts of the found lines and of the visible walls, cut where they change between near and far from the other
/// set, by the rules of the metric family `raster_truth`. Absent without walls.
std::optional<render::PixelDifference> line_difference(const Recording& recording, const PipelineResult& result,
                                                       const metrics::RasterRules& rules);

/// The parameters of `raster_truth` in a scenario's list of metrics; the default ones if it is not in the list.
metrics::RasterRules raster_rules(const std::vector<study::ModuleChoice>& families);

}  // namespace scanbench::results
