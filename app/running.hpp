// A run as a person at the terminal sees it: progress, failures as they happen, and reports at its end.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/report/page_input.hpp"
#include "harness/run/run_options.hpp"
#include "harness/scenario/scenario.hpp"

namespace scanbench::app {

struct Presentation {
  bool quiet = false;   ///< no progress
  bool figures = true;  ///< draw the scenarios' figures
};

struct FinishedRun {
  harness::RunResult result;
  std::optional<harness::ReportInput> report;  ///< none if it could not be written, which has been said
  std::string figure_failure;                  ///< why there are no figures; empty if there are
};

/// Runs, draws and writes the report. `options.progress` and `options.finish` are replaced.
FinishedRun run_and_report(const std::vector<harness::Scenario>& scenarios, harness::RunOptions options,
                           const Presentation& presentation);

/// What is said on standard error after a run that was interrupted or is incomplete; empty if there is nothing to say.
/// `how`: what makes an interrupted one go on.
std::string unfinished_text(const harness::RunResult& result, const std::string& how = "--resume continues");

}  // namespace scanbench::app
