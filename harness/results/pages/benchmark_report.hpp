// The page of a benchmark: what was run, the ranking, four figures, the meaning of the columns, and the limits of the
// benchmark.
#pragma once

#include "harness/results/document/document.hpp"
#include "harness/results/pages/page_input.hpp"

namespace scanbench::results {

/// `input.benchmark` must have a value, and `input.ranking` its pipelines.
Document benchmark_document(const ReportInput& input);

}  // namespace scanbench::results
