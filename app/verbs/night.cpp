// The verbs `night run`, `night accept` and `night store`: results that are kept from night to night.
#include "app/verbs/night.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/inputs.hpp"
#include "app/options.hpp"
#include "app/seed_list.hpp"
#include "app/terminal/progress.hpp"
#include "app/terminal/running.hpp"
#include "core/error.hpp"
#include "harness/results/analysis/run_results.hpp"
#include "harness/results/document/plain_text.hpp"
#include "harness/results/nightly/baseline.hpp"
#include "harness/results/nightly/night.hpp"
#include "harness/results/nightly/night_page.hpp"
#include "harness/results/nightly/store.hpp"
#include "harness/runs/store/run_scenarios.hpp"

namespace scanbench::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBaselines = "baselines";

struct NightOptions {
  std::vector<std::string> files, sets, seeds;
  std::string store, out, suite, baseline;
  std::string baselines = kBaselines;
  int jobs = 1;
  bool quiet = false, no_figures = false;
};

struct AcceptOptions {
  std::vector<std::string> runs;  // one
  std::string suite, reason;
  std::string baselines = kBaselines;
};

struct StoreOptions {
  std::string store, suite;
  std::vector<std::string> runs;
};

int run_night(const NightOptions& options, const std::vector<std::string>& argv) {
  if (options.files.size() > 1 && options.suite.empty())
    throw ConfigError(fmt::format("night run: {} files have no common name; --suite must name the suite that they make",
                                  options.files.size()));
  std::string suite;
  runs::RunOptions run_options;
  auto scenarios = load_inputs(options.files, options.sets, &suite, &run_options.rules);
  if (!options.suite.empty()) suite = options.suite;
  io::check_name("suite", suite);
  give_seeds(scenarios, options.seeds);
  run_options.out = options.out.empty() ? fs::path("out/nightly") / suite : fs::path(options.out);
  run_options.jobs = options.jobs;
  run_options.resume = true;
  run_options.argv = argv;
  if (options.baselines != kBaselines && !fs::is_directory(options.baselines))
    throw ConfigError("--baselines: there is no folder " + options.baselines);
  results::Store store(options.store);  // a store that cannot be used is said before the night, not after it
  results::NightPlan plan{.suite = suite,
                          .run = run_options.out,
                          .baselines = options.baselines,
                          .baseline = options.baseline,
                          .gates = results::Gates(run_options.rules.gates)};
  results::check_plan(plan);
  const FinishedRun finished =
      run_and_report(scenarios, run_options, {.quiet = options.quiet, .figures = !options.no_figures});
  say(unfinished_text(finished.result, "the same command continues"));
  if (finished.result.interrupted) return kInterrupted;
  if (finished.result.old_run_kept) {  // the folder has the earlier night: it must not count as this one
    fmt::print("INCOMPLETE: cells are missing, so this night is neither stored nor judged\n");
    return kIncomplete;
  }
  plan.run = finished.result.out;
  plan.reused = static_cast<std::size_t>(
      std::ranges::count_if(finished.result.cells, [](const runs::CellResult& cell) { return cell.reused; }));
  const results::NightOutcome outcome = results::close_night(plan, std::move(store));
  if (!options.quiet) fmt::print("{}\n", results::reuse_text(finished.result.cells.size(), plan.reused));
  fmt::print("{}\n", results::plain_line(outcome.sentence, 2000));
  if (!options.quiet) fmt::print("{}\n", outcome.page.string());
  if (finished.result.exit_code() == kIncomplete) return outcome.exit_code | kIncomplete;
  return outcome.exit_code;
}

int accept(const AcceptOptions& options) {
  check_run_exists(options.runs.front());
  const results::RunResults results = results::load_run_results(options.runs.front());
  const std::string suite = options.suite.empty() ? results::suite_of_run(options.runs.front()) : options.suite;
  const fs::path file = results::accept_baseline(
      options.baselines, suite, results, results::Gates(runs::load_gates(options.runs.front())), options.reason);
  fmt::print("{}\n", file.string());
  return kGood;
}

int add_to_store(const StoreOptions& options) {
  results::Store store(options.store);
  for (const auto& run : options.runs) {
    check_run_exists(run);
    const results::RunResults results = results::load_run_results(run);
    const std::string suite = options.suite.empty() ? results::suite_of_run(run) : options.suite;
    store.replace(suite, run, results);
    fmt::print("{}: {} cells\n", run, results.cells.size());
  }
  return kGood;
}

void add_night_run(Verb& night, const CommandLine& line) {
  auto options = std::make_shared<NightOptions>();
  Verb verb =
      night.add_verb("run", "Runs a suite, keeps its results, judges them against the baseline and writes a page");
  verb.details(
      "The exit code is 1 if a gate is worse or a cell failed, 2 if nothing could be compared, 4 if cells are missing, "
      "5 "
      "if both 1 and 4.");
  verb.option("FILE", options->files, "a suite, or scenario files").required();
  verb.option("--store", options->store, "the file that keeps the results of all nights (SQLite)").required();
  verb.option("-o,--out", options->out, "the run folder, used again every night (default: out/nightly/<suite>)");
  verb.option("--suite", options->suite,
              "the suite's name, under which its nights and baselines are kept (default: that of the file; "
              "several files need one)");
  verb.option("--baselines", options->baselines, "folder of the accepted baselines").shows_default();
  verb.option("--baseline", options->baseline,
              "number of the baseline to compare with, such as 3 (default: the newest; without baselines the "
              "last good night)");
  add_jobs_option(verb, options->jobs, "number of cells that run at the same time");
  add_seed_option(verb, options->seeds);
  add_set_option(verb, options->sets);
  verb.flag("--no-figures", options->no_figures, "draw no figures of the scenarios");
  verb.flag("-q,--quiet", options->quiet, "print only the verdict and errors");
  verb.runs([&line, options] { return run_night(*options, line.argv()); });
}

constexpr const char* kSuiteHelp = "the suite's name (default: that of its night, else of its folder)";

void add_night_accept(Verb& night) {
  auto options = std::make_shared<AcceptOptions>();
  Verb verb = night.add_verb("accept", "Makes the values of a run the suite's new baseline");
  verb.option("RUN", options->runs, "a complete run folder").required().values(1, 1);
  verb.option("--reason", options->reason, "why the baseline moves, for those who read it later").required();
  verb.option("--suite", options->suite, kSuiteHelp);
  verb.option("--baselines", options->baselines, "folder of the baselines").shows_default();
  verb.runs([options] { return accept(*options); });
}

void add_night_store(Verb& night) {
  auto options = std::make_shared<StoreOptions>();
  Verb verb = night.add_verb("store", "Adds finished runs to a store of nights, or makes it again from them");
  verb.option("FILE", options->store, "the store (made if there is none)").required();
  verb.option("RUN", options->runs, "run folders, oldest first").required();
  verb.option("--suite", options->suite, kSuiteHelp);
  verb.runs([options] { return add_to_store(*options); });
}

}  // namespace

void add_night(CommandLine& line) {
  Verb night = line.add_verb("night", "A suite every night: run, accept, store");
  night.details("docs/nightly.md is the guide.");
  add_night_run(night, line);
  add_night_accept(night);
  add_night_store(night);
}

}  // namespace scanbench::app
