// A pipeline that merges given lines with mean_shift, and its trace, for the tests of figures.
#pragma once

#include <span>

#include "core/line_map.hpp"
#include "core/params.hpp"
#include "core/recording.hpp"
#include "core/result.hpp"
#include "core/trace/trace_rows.hpp"

namespace scanbench::render::test {

struct Merged {
  PipelineResult result;
  TraceRows trace;
};

/// One frame at the world's origin with the lines, and `points` for them.
Merged merged_by_mean_shift(std::span<const MapLine> lines, std::span<const Vec2> points = {},
                            const ParamSet& params = {});

/// The same of the lines of all frames of a result, placed by the true poses.
Merged merged_by_mean_shift(const Recording& recording, const PipelineResult& found);

/// A recording of one scan without a return.
Recording blind_recording();

}  // namespace scanbench::render::test
