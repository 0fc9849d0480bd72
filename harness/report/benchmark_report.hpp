// The page of a benchmark: what was run, the ranking, four figures, the meaning of the columns, and the limits of the
// benchmark.
#pragma once

#include "harness/page/document.hpp"
#include "harness/report/page_input.hpp"

namespace scanbench::harness {

/// `input.benchmark` must have a value, and `input.ranking` its pipelines.
Document benchmark_document(const ReportInput& input);

}  // namespace scanbench::harness
