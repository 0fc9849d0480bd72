// The verbs nightly, accept and store: results that are kept from night to night.
#include "app/nightly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/inputs.hpp"
#include "app/option_checks.hpp"
#include "app/progress.hpp"
#include "app/running.hpp"
#include "core/error.hpp"
#include "harness/analysis/run_results.hpp"
#include "harness/nightly/baseline.hpp"
#include "harness/nightly/night.hpp"
#include "harness/nightly/night_page.hpp"
#include "harness/nightly/store.hpp"
#include "harness/page/plain_text.hpp"
#include "harness/store/run_scenarios.hpp"

namespace scanbench::app {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> files, runs, sets, seeds;
  std::string store, out, suite, reason, baseline;
  std::string baselines = "baselines";
  int jobs = 1;
  bool quiet = false, no_figures = false;
};

int nightly(const Options& options, const std::vector<std::string>& argv) {
  if (options.files.size() > 1 && options.suite.empty())
    throw ConfigError(fmt::format("nightly: {} files have no common name; --suite must name the suite that they make",
                                  options.files.size()));
  std::string suite;
  harness::RunOptions run_options;
  auto scenarios = load_inputs(options.files, options.sets, &suite, &run_options.rules);
  if (!options.suite.empty()) suite = options.suite;
  harness::check_name("suite", suite);
  give_seeds(scenarios, options.seeds);
  run_options.out = options.out.empty() ? fs::path("out/nightly") / suite : fs::path(options.out);
  run_options.jobs = options.jobs;
  run_options.resume = true;
  run_options.argv = argv;
  if (options.baselines != Options().baselines && !fs::is_directory(options.baselines))
    throw ConfigError("--baselines: there is no folder " + options.baselines);
  harness::Store store(options.store);  // a store that cannot be used is said before the night, not after it
  harness::NightPlan plan{.suite = suite,
                          .run = run_options.out,
                          .baselines = options.baselines,
                          .baseline = options.baseline,
                          .gates = harness::Gates(run_options.rules.gates)};
  harness::check_plan(plan);
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
      std::ranges::count_if(finished.result.cells, [](const harness::CellResult& cell) { return cell.reused; }));
  const harness::NightOutcome outcome = harness::close_night(plan, store);
  if (!options.quiet) fmt::print("{}\n", harness::reuse_text(finished.result.cells.size(), plan.reused));
  fmt::print("{}\n", harness::plain_line(outcome.sentence, 2000));
  if (!options.quiet) fmt::print("{}\n", outcome.page.string());
  if (finished.result.exit_code() == kIncomplete) return outcome.exit_code | kIncomplete;
  return outcome.exit_code;
}

int accept(const Options& options) {
  check_run_exists(options.runs.front());
  const harness::RunResults results = harness::load_run_results(options.runs.front());
  const std::string suite = options.suite.empty() ? harness::suite_of_run(options.runs.front()) : options.suite;
  const fs::path file = harness::accept_baseline(
      options.baselines, suite, results, harness::Gates(harness::load_gates(options.runs.front())), options.reason);
  fmt::print("{}\n", file.string());
  return kGood;
}

int add_to_store(const Options& options) {
  harness::Store store(options.store);
  for (const auto& run : options.runs) {
    check_run_exists(run);
    const harness::RunResults results = harness::load_run_results(run);
    const std::string suite = options.suite.empty() ? harness::suite_of_run(run) : options.suite;
    store.replace(suite, run, results);
    fmt::print("{}: {} cells\n", run, results.cells.size());
  }
  return kGood;
}

}  // namespace

void add_nightly(Context& context) {
  auto options = std::make_shared<Options>();
  auto* night = context.app.add_subcommand(
      "nightly",
      "Runs a suite, keeps its results, judges them against the baseline and writes a page; exit code 1 if a gate is "
      "worse, 4 if cells are missing, 5 if both");
  night->add_option("FILE", options->files, "a suite, or scenario files")->required();
  night->add_option("--store", options->store, "the file that keeps the results of all nights (SQLite)")->required();
  night->add_option("-o,--out", options->out, "the run folder, used again every night (default: out/nightly/<suite>)");
  night->add_option("--suite", options->suite,
                    "the suite's name, under which its nights and baselines are kept (default: that of the file; "
                    "several files need one)");
  night->add_option("--baselines", options->baselines, "folder of the accepted baselines")->capture_default_str();
  night->add_option("--baseline", options->baseline,
                    "number of the baseline to compare with, such as 3 (default: the newest; without baselines the "
                    "last good night)");
  night->add_option("-j,--jobs", options->jobs, "number of cells that run at the same time")
      ->check(whole_number("number of cells", 1, 1024))
      ->capture_default_str();
  night->add_option("--seed", options->seeds, "seeds, separated by commas, that replace the file's")->delimiter(',');
  night->add_option("--set", options->sets, "KEY=VALUE: replaces a value of the file (dotted keys)")->take_all();
  night->add_flag("--no-figures", options->no_figures, "draw no figures of the scenarios");
  night->add_flag("-q,--quiet", options->quiet, "print only the verdict and errors");
  night->callback(
      [&context, options] { context.action = [options, argv = context.argv] { return nightly(*options, argv); }; });

  auto* accept_verb = context.app.add_subcommand("accept", "Makes the values of a run the suite's new baseline");
  accept_verb->add_option("RUN", options->runs, "a complete run folder")->required()->expected(1);
  accept_verb->add_option("--reason", options->reason, "why the baseline moves, for those who read it later")
      ->required();
  accept_verb->add_option("--suite", options->suite,
                          "the suite's name (default: that of its night, else of its folder)");
  accept_verb->add_option("--baselines", options->baselines, "folder of the baselines")->capture_default_str();
  accept_verb->callback([&context, options] { context.action = [options] { return accept(*options); }; });

  auto* store_verb =
      context.app.add_subcommand("store", "Adds finished runs to a store of nights, or makes it again from them");
  store_verb->add_option("FILE", options->store, "the store (made if there is none)")->required();
  store_verb->add_option("RUN", options->runs, "run folders, oldest first")->required();
  store_verb->add_option("--suite", options->suite,
                         "the suite's name (default: that of its night, else of its folder)");
  store_verb->callback([&context, options] { context.action = [options] { return add_to_store(*options); }; });
}

}  // namespace scanbench::app
