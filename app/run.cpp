// The verb run, which runs scenarios and suites into a run folder with tables, figures and a report.
#include "app/run.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <optional>

#include <nlohmann/json.hpp>

#include "app/drawing.hpp"
#include "app/fault_notes.hpp"
#include "app/forecast.hpp"
#include "app/inputs.hpp"
#include "app/option_checks.hpp"
#include "app/progress.hpp"
#include "core/error.hpp"
#include "harness/report/page_input.hpp"
#include "harness/report/plain_text.hpp"
#include "harness/report/run_report.hpp"
#include "harness/report/scenario_tables.hpp"
#include "harness/run/run_options.hpp"
#include "harness/run/runner.hpp"
#include "harness/scenario/benchmark_spec.hpp"
#include "harness/store/cell_status.hpp"
#include "harness/store/run_scenarios.hpp"

namespace scanbench::app {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> files, sets, seeds, only;
  std::string out;
  int jobs = 1;
  bool resume = false, quiet = false, json = false, journal = false, no_figures = false, dry_run = false;
};

std::size_t terminal_width() {
  winsize size{};
  if (isatty(STDOUT_FILENO) && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 40) return size.ws_col;
  return 120;
}

void print_tables(const harness::ReportInput& input) {
  for (const auto& table : harness::closing_tables(input))
    fmt::print("{}\n", harness::to_terminal(table, use_color(), terminal_width()));
}

void print_json(const harness::RunResult& result) {
  auto cells = nlohmann::ordered_json::array();
  for (const auto& cell : result.cells)
    cells.push_back({{"scenario", cell.key.scenario},
                     {"pipeline", cell.key.pipeline},
                     {"seed", cell.key.seed},
                     {"status", cell.done ? to_string(cell.record.outcome.status) : "missing"},
                     {"message", harness::plain_line(cell.record.outcome.message)},
                     {"reused", cell.reused}});
  const nlohmann::ordered_json json{{"out", result.out.string()}, {"exit_code", result.exit_code()}, {"cells", cells}};
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void note_cell(Progress& progress, FaultNotes& faults, const harness::CellResult& cell) {
  if (cell.record.outcome.status == harness::CellStatus::ok) return;
  progress.failure();
  if (const std::string note = faults.note(cell); !note.empty()) progress.note(note);
}

void note_absent_figures(const harness::ReportInput& report) {
  for (const auto& figure : report.figures)
    if (figure.name.empty()) say(fmt::format("{}: note: {}\n", figure.scenario, figure.caption));
}

/// Draws the figures of a run, unless the user wants none, and writes its report. `failure`: why they were not drawn.
harness::ReportInput write_report(const harness::RunResult& result, const Options& options, Progress& progress,
                                  std::string& failure) {
  const auto scenarios = harness::load_run_scenarios(result.out);
  if (!options.no_figures) failure = draw_within_limits(result.out, scenarios, false, progress);
  auto report = harness::load_report_input(result.out, scenarios);
  harness::write_reports(result.out, report);
  return report;
}

/// The message about missing cells: their number, the reason of the first, and whether an earlier run remains.
std::string missing_text(const harness::RunResult& result) {
  const auto is_missing = [](const harness::CellResult& cell) { return !cell.done; };
  const auto first = std::ranges::find_if(result.cells, is_missing);
  return fmt::format("scanbench: {} of {} cells are missing; {}: {}{}\n",
                     std::ranges::count_if(result.cells, is_missing), result.cells.size(),
                     harness::to_string(first->key), harness::plain_line(first->record.outcome.message),
                     result.old_run_kept ? "; the earlier run in " + result.out.string() + " is unchanged" : "");
}

/// How many cells did not end well, and why the first one did not; empty if all did.
std::string failed_text(const harness::RunResult& result) {
  const auto has_failed = [](const harness::CellResult& cell) {
    return cell.done && cell.record.outcome.status != harness::CellStatus::ok;
  };
  const auto first = std::ranges::find_if(result.cells, has_failed);
  if (first == result.cells.end()) return "";
  return fmt::format("scanbench: {} of {} cells failed; {}: {}: {}\n", std::ranges::count_if(result.cells, has_failed),
                     result.cells.size(), harness::to_string(first->key), to_string(first->record.outcome.status),
                     harness::plain_line(first->record.outcome.message));
}

int run(const Options& options, const std::vector<std::string>& argv) {
  std::string name;
  std::optional<harness::BenchmarkSpec> benchmark;
  auto scenarios = load_inputs(options.files, options.sets, &name, &benchmark);
  give_seeds(scenarios, options.seeds);
  for (const auto& scenario : scenarios)
    for (const auto& note : scenario.notes)
      if (!options.quiet) say(fmt::format("{}: note: {}\n", scenario.name, note));

  harness::RunOptions run_options;
  run_options.out = options.out.empty() ? fs::path("out") / name : fs::path(options.out);
  run_options.jobs = options.jobs;
  run_options.only = options.only;
  run_options.resume = options.resume;
  run_options.journal = options.journal;
  run_options.argv = argv;
  run_options.benchmark = benchmark;
  if (options.dry_run) return print_forecast(scenarios, run_options, options.quiet);
  Progress progress(progress_style(options.quiet));
  FaultNotes faults;
  run_options.progress = [&](const harness::RunProgress& now) {
    if (now.cell != nullptr) note_cell(progress, faults, *now.cell);
    const double total = static_cast<double>(now.total);
    progress.update(total > 0 ? 0.95 * static_cast<double>(now.done) / total : 0.0, now.what);
  };
  std::optional<harness::ReportInput> report;
  std::string figure_failure;
  run_options.finish = [&](const harness::RunResult& result) {
    const InterruptGuard guard;
    try {
      report = write_report(result, options, progress, figure_failure);
    } catch (const ConfigError& error) {
      if (result.exit_code() != kIncomplete) throw;  // else the report fails for the same reason
      say(fmt::format("scanbench: {}\n", error.what()));
    }
  };
  const harness::RunResult result = harness::run(scenarios, run_options);
  for (const auto& line : faults.repeated()) progress.note(line);
  progress.finish();
  if (result.interrupted) {
    say(fmt::format("scanbench: interrupted; the finished cells of a new run stay in {} (--resume continues)\n",
                    result.out.string()));
    return kInterrupted;
  }
  if (result.exit_code() == kIncomplete) say(missing_text(result));
  if (options.quiet) say(failed_text(result));
  if (!figure_failure.empty()) say("scanbench: " + figure_failure + "\n");

  if (!options.quiet && report) note_absent_figures(*report);
  if (options.json) {
    print_json(result);
  } else if (!options.quiet && report) {
    print_tables(*report);
    fmt::print("{}\n", (result.out / harness::kReportPage).string());
  }
  return result.exit_code() == kGood && !figure_failure.empty() ? kCellsFailed : result.exit_code();
}

}  // namespace

void add_run(Context& context) {
  auto options = std::make_shared<Options>();
  auto* verb =
      context.app.add_subcommand("run", "Runs scenario or suite files: scans, algorithms, metrics, figures, report");
  verb->add_option("FILE", options->files, "scenario or suite files")->required();
  verb->add_option("-o,--out", options->out, "the run folder (default: out/<name of the first file>)");
  verb->add_option("--seed", options->seeds, "seeds, separated by commas, that replace the file's")->delimiter(',');
  verb->add_option("-j,--jobs", options->jobs, "number of cells that run at the same time")
      ->check(whole_number("number of cells", 1, 1024))
      ->capture_default_str();
  verb->add_option("--set", options->sets, "KEY=VALUE: replaces a value of the file (dotted keys)")->take_all();
  verb->add_option("--only", options->only,
                   "only these scenarios, pipelines or scenario/pipeline; the other cells of an earlier run stay")
      ->delimiter(',');
  verb->add_flag("--resume", options->resume, "reuse the cells of an earlier run that have not changed");
  verb->add_flag("--trace", options->journal, "write the intermediate results of the algorithms (trace.csv)");
  verb->add_flag("--dry-run", options->dry_run,
                 "print how many cells, rays, bytes and seconds the run would take, from a trial of a few scans; write "
                 "nothing");
  verb->add_flag("--no-figures", options->no_figures, "draw no figures");
  verb->add_flag("-q,--quiet", options->quiet, "print only errors");
  verb->add_flag("--json", options->json, "print the cells' outcomes as JSON");
  verb->callback(
      [&context, options] { context.action = [options, argv = context.argv] { return run(*options, argv); }; });
}

}  // namespace scanbench::app
