// A run as a person at the terminal sees it: progress, failures as they happen, and reports at its end.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/results/pages/page_input.hpp"
#include "harness/runs/execute/run_options.hpp"
#include "harness/study/scenario/scenario.hpp"

namespace scanbench::app {

struct Presentation {
  bool quiet = false;   ///< no progress
  bool figures = true;  ///< draw the scenarios' figures
  bool report = true;   ///< write the report, with the figures if wanted
};

struct FinishedRun {
  runs::RunResult result;
  std::optional<results::ReportInput> report;  ///< none if it could not be written, which has been said
  std::string sentence;                        ///< with which its page begins; empty if there is no report
  std::string figure_failure;                  ///< why there are no figures; empty if there are
};

/// Makes a run: runs::run(), or a merge of shards.
using MakeRun = std::function<runs::RunResult(const runs::RunOptions&)>;

/// Makes a run, draws and writes the report. `options.progress` and `options.finish` are replaced.
FinishedRun make_and_report(const MakeRun& make, runs::RunOptions options, const Presentation& presentation);

/// The same with the run of these scenarios.
FinishedRun run_and_report(const std::vector<study::Scenario>& scenarios, const runs::RunOptions& options,
                           const Presentation& presentation);

/// Prints what closes a run: its tables, the sentence with which its page begins, and the page's name.
void print_ending(const FinishedRun& finished);

/// Why figures that the scenarios name are absent.
void note_absent_figures(const results::ReportInput& report);

/// How many cells did not end well, and why the first one did not; empty if all did.
std::string failed_text(const std::vector<runs::CellResult>& cells);

/// What is said on standard error after a run that was interrupted or is incomplete; empty if there is nothing to say.
/// `how`: what makes an interrupted one go on.
std::string unfinished_text(const runs::RunResult& result, const std::string& how = "--resume continues");

}  // namespace scanbench::app
