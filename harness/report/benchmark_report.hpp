// The page of a benchmark: what was run, the ranking, four figures, the meaning of the columns, and the limits of the
// benchmark.
#pragma once

#include <string>

#include "harness/analysis/benchmark.hpp"
#include "harness/report/page_input.hpp"
#include "harness/scenario/benchmark_spec.hpp"

namespace scanbench::harness {

std::string benchmark_html(const ReportInput& input, const BenchmarkSpec& spec);
std::string benchmark_markdown(const ReportInput& input, const BenchmarkSpec& spec);

}  // namespace scanbench::harness
