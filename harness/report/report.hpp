// The report of a run.
#pragma once

#include "harness/page/document.hpp"
#include "harness/report/page_input.hpp"

namespace scanbench::harness {

/// Answers first, then each scenario with its figures and tables. `input.results` must have every scenario.
Document report_document(const ReportInput& input);

}  // namespace scanbench::harness
