// The report of a run.
#pragma once

#include "harness/results/document/document.hpp"
#include "harness/results/pages/page_input.hpp"

namespace scanbench::results {

/// The title of a run: the words of its scenario, and of a recorded one its log; of several, the first two and how many
/// more there are.
std::string report_title(const std::vector<study::Scenario>& scenarios);

/// Answers first, then each scenario with its figures and tables. `input.results` must have every scenario.
Document report_document(const ReportInput& input);

}  // namespace scanbench::results
