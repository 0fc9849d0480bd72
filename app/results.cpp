// The verbs score, figures and report, which work on existing run folders.
#include "app/results.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/drawing.hpp"
#include "app/inputs.hpp"
#include "app/progress.hpp"
#include "core/error.hpp"
#include "harness/report/run_report.hpp"
#include "harness/run/runner.hpp"
#include "harness/run/score.hpp"
#include "harness/store/manifest.hpp"
#include "harness/store/run_folder.hpp"
#include "harness/store/run_lock.hpp"
#include "harness/store/run_scenarios.hpp"

namespace scanbench::app {
namespace {

namespace fs = std::filesystem;

// Scenarios of the run, or of files that replace them (to score with other metrics, to draw other figures).
std::vector<harness::Scenario> scenarios_for(const fs::path& run, const std::vector<std::string>& files) {
  check_run_exists(run);
  return files.empty() ? harness::load_run_scenarios(run) : load_inputs(files, {});
}

int score(const fs::path& run, const std::vector<std::string>& files, bool quiet) {
  const auto scenarios = scenarios_for(run, files);
  const harness::RunLock lock(run);
  harness::refuse_linked_folders(run);
  const InterruptGuard guard;
  Progress progress(progress_style(quiet));
  const std::size_t cells = harness::score_run(
      run, scenarios, [&](double share, const std::string& what) { progress.update(share, "score " + what); });
  progress.finish();
  harness::write_reports(run, harness::load_report_input(run, scenarios));
  if (!quiet)
    fmt::print("{} cell{} scored: {}\n", cells, cells == 1 ? "" : "s", (run / harness::kSummaryFile).string());
  const auto planned = harness::load_manifest(run).cells;
  const auto missing = std::ranges::count_if(
      planned, [&](const auto& key) { return !fs::exists(harness::cell_path(run, key) / "status.json"); });
  if (missing == 0) return kGood;
  fmt::print("INCOMPLETE: {} of {} cells are missing\n", missing, planned.size());
  return kIncomplete;
}

int figures(const fs::path& run, const std::vector<std::string>& files, bool pdf, bool quiet) {
  const auto scenarios = scenarios_for(run, files);
  const harness::RunLock lock(run);
  harness::refuse_linked_folders(run);
  const InterruptGuard guard;
  Progress progress(progress_style(quiet));
  const std::string failure = draw_within_limits(run, scenarios, pdf, progress);
  progress.finish();
  if (!failure.empty()) {
    say("scanbench: " + failure + "\n");
    return kCellsFailed;
  }
  if (quiet) return kGood;
  const auto drawn = harness::load_figure_index(run);
  for (const auto& figure : drawn) {
    if (figure.name.empty())
      fmt::print("{}: {}\n", figure.scenario, figure.caption);
    else
      fmt::print("{}\n", (run / "figures" / (figure.name + ".svg")).string());
  }
  if (drawn.empty())
    fmt::print("nothing to draw: {}\n",
               std::ranges::any_of(scenarios, [](const auto& s) { return !s.figures.empty(); })
                   ? "the run has no recordings"
                   : "the scenarios name no figures (--with FILE takes those of other scenario files)");
  return kGood;
}

int report(const fs::path& run) {
  const auto scenarios = scenarios_for(run, {});
  const harness::RunLock lock(run);
  harness::refuse_linked_folders(run);
  harness::write_reports(run, harness::load_report_input(run, scenarios));
  fmt::print("{}\n{}\n", (run / harness::kReportPage).string(), (run / harness::kReportMarkdown).string());
  return kGood;
}

}  // namespace

void add_results(Context& context) {
  struct Options {
    std::string run;
    std::vector<std::string> files;
    bool pdf = false, quiet = false;
  };
  auto options = std::make_shared<Options>();

  auto* score_verb = context.app.add_subcommand("score", "Computes the metrics of a run again, from its files");
  score_verb->add_option("RUN", options->run, "a run folder")->required();
  score_verb->add_option("--with", options->files, "scenario files whose metrics replace the run's own");
  score_verb->add_flag("-q,--quiet", options->quiet, "print only errors and missing cells");
  score_verb->callback([&context, options] {
    context.action = [options] { return score(options->run, options->files, options->quiet); };
  });

  auto* figures_verb = context.app.add_subcommand("figures", "Draws the figures of a run again, from its files");
  figures_verb->add_option("RUN", options->run, "a run folder")->required();
  figures_verb->add_option("--with", options->files, "scenario files whose figures replace the run's own");
  figures_verb->add_flag("--pdf", options->pdf, "also as PDF");
  figures_verb->add_flag("-q,--quiet", options->quiet, "print only errors");
  figures_verb->callback([&context, options] {
    context.action = [options] { return figures(options->run, options->files, options->pdf, options->quiet); };
  });

  auto* report_verb = context.app.add_subcommand("report", "Writes report.html and report.md of a run again");
  report_verb->add_option("RUN", options->run, "a run folder")->required();
  report_verb->callback([&context, options] { context.action = [options] { return report(options->run); }; });
}

}  // namespace scanbench::app
