// Success of aligners against the error of the poses that they were given.
#pragma once

#include <string>
#include <vector>

#include "harness/runs/store/summary.hpp"
#include "harness/study/scenario/benchmark_subject.hpp"
#include "harness/study/scenario/scenario.hpp"
#include "render/charts/facets.hpp"

namespace scanbench::results {

/// One panel per pipeline, in this order. A point is the mean of the column's metric over the scenarios with the same
/// sensor and the same standard deviations of the given poses, then over the seeds, with its 95 % interval, which is
/// cut at 0 and 1. Start errors are equally spaced. The first two sensors have a curve each. The scenarios must be
/// simulated and not empty.
render::FacetChart basin_chart(const std::vector<study::Scenario>& scenarios, const std::vector<runs::SummaryRow>& rows,
                               const std::vector<std::string>& pipelines, const study::BenchmarkColumn& column);

}  // namespace scanbench::results
