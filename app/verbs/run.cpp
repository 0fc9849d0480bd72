// The verb run, which runs scenarios and suites into a run folder with tables, figures and a report.
#include "app/verbs/run.hpp"

#include <fmt/format.h>

#include <memory>

#include <nlohmann/json.hpp>

#include "app/foreign.hpp"
#include "app/inputs.hpp"
#include "app/options.hpp"
#include "app/seed_list.hpp"
#include "app/terminal/forecast.hpp"
#include "app/terminal/progress.hpp"
#include "app/terminal/running.hpp"
#include "app/text_format.hpp"
#include "core/error.hpp"
#include "harness/io/files/json.hpp"
#include "harness/results/document/plain_text.hpp"
#include "harness/runs/execute/run_options.hpp"
#include "harness/runs/store/cell_status.hpp"

namespace scanbench::app {
namespace {

namespace fs = std::filesystem;

struct RunVerbOptions {
  std::vector<std::string> files, sets, seeds, only;
  std::string out;
  int jobs = 1;
  bool sandbox = false;
  ForeignOptions foreign;
  bool resume = false, quiet = false, json = false, journal = false, no_figures = false, dry_run = false;
};

void print_json(const runs::RunResult& result) {
  auto cells = nlohmann::ordered_json::array();
  for (const auto& cell : result.cells)
    cells.push_back({{"scenario", cell.key.scenario},
                     {"pipeline", cell.key.pipeline},
                     {"seed", cell.key.seed},
                     {"status", cell.done ? to_string(cell.record.outcome.status) : "missing"},
                     {"message", results::plain_line(cell.record.outcome.message)},
                     {"reused", cell.reused}});
  const nlohmann::ordered_json json{{"out", result.out.string()}, {"exit_code", result.exit_code()}, {"cells", cells}};
  fmt::print("{}\n", io::json_text(json));
}

int run(const RunVerbOptions& options, const std::vector<std::string>& argv) {
  std::string name;
  runs::RunOptions run_options;
  auto scenarios = load_inputs(options.files, with_foreign(options.sets, options.foreign, options.sandbox), &name,
                               &run_options.rules);
  give_seeds(scenarios, options.seeds);
  for (const auto& scenario : scenarios)
    for (const auto& note : scenario.notes)
      if (!options.quiet) say(fmt::format("{}: note: {}\n", scenario.name, note));

  run_options.out = options.out.empty() ? fs::path("out") / name : fs::path(options.out);
  run_options.jobs = options.jobs;
  run_options.only = options.only;
  run_options.resume = options.resume;
  run_options.journal = options.journal;
  run_options.argv = argv;
  if (options.dry_run) return print_forecast(scenarios, run_options, options.quiet);
  const FinishedRun finished =
      run_and_report(scenarios, run_options, {.quiet = options.quiet, .figures = !options.no_figures});
  const runs::RunResult& result = finished.result;
  say(unfinished_text(result));
  if (result.interrupted) return kInterrupted;
  if (options.quiet) say(failed_text(result.cells));
  if (!finished.figure_failure.empty()) say("scanbench: " + finished.figure_failure + "\n");

  if (!options.quiet && finished.report) note_absent_figures(*finished.report);
  if (options.json)
    print_json(result);
  else if (!options.quiet && finished.report)
    print_ending(finished);
  return result.exit_code() == kGood && !finished.figure_failure.empty() ? kCellsFailed : result.exit_code();
}

}  // namespace

void add_run(CommandLine& line) {
  auto options = std::make_shared<RunVerbOptions>();
  Verb verb = line.add_verb("run", "Runs scenario or suite files: scans, algorithms, metrics, figures, report");
  verb.option("FILE", options->files, "scenario or suite files").required();
  verb.option("-o,--out", options->out, "the run folder (default: out/<name of the first file>)");
  add_seed_option(verb, options->seeds);
  add_jobs_option(verb, options->jobs, "number of cells that run at the same time");
  add_set_option(verb, options->sets);
  verb.option("--only", options->only,
              "only these scenarios, pipelines or scenario/pipeline; the other cells of an earlier run stay")
      .separated_by_commas();
  verb.flag("--resume", options->resume, "reuse the cells of an earlier run that have not changed");
  verb.flag("--trace", options->journal, "write the intermediate results of the algorithms (trace.csv)");
  verb.flag("--dry-run", options->dry_run,
            "print how many cells, rays, bytes and seconds the run would take, from a trial of a few scans; write "
            "nothing");
  verb.flag("--no-figures", options->no_figures, "draw no figures");
  add_foreign_options(verb, options->foreign, false);
  verb.flag("--sandbox", options->sandbox,
            "run programs under bubblewrap (no network, read-only but for the cell's folder) and libraries without "
            "network");
  verb.flag("-q,--quiet", options->quiet, "print only errors");
  add_json_flag(verb, options->json, "the outcomes of the cells");
  verb.renamed("--plan", "`run --plan SWEEP` is now `sweep run SWEEP`");
  verb.renamed("--shard", "`run --plan SWEEP --shard N` is now `sweep run SWEEP --shard N`");
  verb.runs([&line, options] { return run(*options, line.argv()); });
}

}  // namespace scanbench::app
