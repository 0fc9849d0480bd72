// Runs with progress and writes reports.
#include "app/terminal/running.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/drawing.hpp"
#include "app/exit_code.hpp"
#include "app/terminal/fault_notes.hpp"
#include "app/terminal/progress.hpp"
#include "core/error.hpp"
#include "harness/results/document/document.hpp"
#include "harness/results/document/plain_text.hpp"
#include "harness/results/pages/run_report.hpp"
#include "harness/runs/execute/runner.hpp"
#include "harness/runs/store/cell_status.hpp"
#include "harness/runs/store/run_scenarios.hpp"

namespace scanbench::app {
namespace {

void note_cell(Progress& progress, FaultNotes& faults, const runs::CellResult& cell) {
  if (cell.record.outcome.status == runs::CellStatus::ok) return;
  progress.failure();
  if (const std::string note = faults.note(cell); !note.empty()) progress.note(note);
}

/// Draws the figures of a run, unless the user wants none, and writes its report.
void write_report(const runs::RunResult& result, bool figures, Progress& progress, FinishedRun& finished) {
  const auto scenarios = runs::load_run_scenarios(result.out);
  if (figures) finished.figure_failure = draw_within_limits(result.out, scenarios, {}, progress);
  auto report = results::load_report_input(result.out, scenarios);
  finished.sentence = results::write_reports(result.out, report);
  finished.report = std::move(report);
}

/// The message about missing cells: their number, the reason of the first, and whether an earlier run remains.
std::string missing_text(const runs::RunResult& result) {
  const auto is_missing = [](const runs::CellResult& cell) { return !cell.done; };
  const auto first = std::ranges::find_if(result.cells, is_missing);
  return fmt::format("scanbench: {} of {} cells are missing; {}: {}{}\n",
                     std::ranges::count_if(result.cells, is_missing), result.cells.size(), runs::to_string(first->key),
                     results::plain_line(first->record.outcome.message),
                     result.old_run_kept ? "; the earlier run in " + result.out.string() + " is unchanged" : "");
}

}  // namespace

void print_ending(const FinishedRun& finished) {
  const results::Document closing = results::closing_document(finished.report.value());
  if (!closing.blocks.empty()) fmt::print("{}\n", results::to_terminal(closing, use_color(), terminal_width()));
  if (!finished.sentence.empty()) fmt::print("{}\n", results::plain_line(finished.sentence, 2000));
  fmt::print("{}\n", (finished.result.out / results::kReportPage).string());
}

void note_absent_figures(const results::ReportInput& report) {
  for (const auto& figure : report.figures)
    if (figure.name.empty()) say(fmt::format("{}: note: {}\n", figure.scenario, figure.caption));
}

std::string failed_text(const std::vector<runs::CellResult>& cells) {
  const auto has_failed = [](const runs::CellResult& cell) {
    return cell.done && cell.record.outcome.status != runs::CellStatus::ok;
  };
  const auto first = std::ranges::find_if(cells, has_failed);
  if (first == cells.end()) return "";
  return fmt::format("scanbench: {} of {} cells failed; {}: {}: {}\n", std::ranges::count_if(cells, has_failed),
                     cells.size(), runs::to_string(first->key), to_string(first->record.outcome.status),
                     results::plain_line(first->record.outcome.message));
}

FinishedRun run_and_report(const std::vector<study::Scenario>& scenarios, const runs::RunOptions& options,
                           const Presentation& presentation) {
  return make_and_report([&](const runs::RunOptions& ready) { return runs::run(scenarios, ready); }, options,
                         presentation);
}

FinishedRun make_and_report(const MakeRun& make, runs::RunOptions options, const Presentation& presentation) {
  Progress progress(progress_style(presentation.quiet));
  FaultNotes faults;
  options.progress = [&](const runs::RunProgress& now) {
    if (now.cell != nullptr) note_cell(progress, faults, *now.cell);
    const auto total = static_cast<double>(now.total);
    progress.update(total > 0 ? 0.95 * static_cast<double>(now.done) / total : 0.0, now.what);
  };
  FinishedRun finished;
  options.finish = {};
  if (presentation.report)
    options.finish = [&](const runs::RunResult& result) {
      const InterruptGuard guard;
      try {
        write_report(result, presentation.figures, progress, finished);
      } catch (const ConfigError& error) {
        if (result.exit_code() != kIncomplete) throw;  // else the report fails for the same reason
        say(fmt::format("scanbench: {}\n", error.what()));
      }
    };
  finished.result = make(options);
  for (const auto& line : faults.repeated()) progress.note(line);
  progress.finish();
  return finished;
}

std::string unfinished_text(const runs::RunResult& result, const std::string& how) {
  if (result.interrupted)
    return fmt::format("scanbench: interrupted; the finished cells of a new run stay in {} ({})\n", result.out.string(),
                       how);
  return result.exit_code() == kIncomplete ? missing_text(result) : "";
}

}  // namespace scanbench::app
