// The report of a run.
#pragma once

#include "harness/results/document/document.hpp"
#include "harness/results/pages/page_input.hpp"

namespace scanbench::results {

/// Answers first, then each scenario with its figures and tables. `input.results` must have every scenario.
Document report_document(const ReportInput& input);

}  // namespace scanbench::results
