// The verbs score, figures, report and compare, which work on existing run folders.
#include "app/results.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/drawing.hpp"
#include "app/inputs.hpp"
#include "app/progress.hpp"
#include "core/error.hpp"
#include "core/number_text.hpp"
#include "harness/analysis/compare.hpp"
#include "harness/files/atomic_file.hpp"
#include "harness/report/run_report.hpp"
#include "harness/report/table.hpp"
#include "harness/run/runner.hpp"
#include "harness/run/score.hpp"
#include "harness/store/manifest.hpp"
#include "harness/store/run_folder.hpp"
#include "harness/store/run_lock.hpp"
#include "harness/store/run_scenarios.hpp"

namespace scanbench::app {
namespace {

namespace fs = std::filesystem;

/// Throws ConfigError, with the nearest name, for a folder that does not exist.
void check_run_exists(const fs::path& run) {
  if (fs::exists(run)) return;
  const std::string near = nearest_file(run);
  throw ConfigError(run.string() + ": no such folder" + (near.empty() ? "" : "; did you mean '" + near + "'?"));
}

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

std::string shown(double value) {
  return std::isnan(value) ? "–" : fmt::format("{:.6g}", value);
}

int compare(const fs::path& a, const fs::path& b, const std::string& csv, bool all) {
  check_run_exists(a);
  check_run_exists(b);
  const harness::Comparison comparison = harness::compare_runs(a, b);
  harness::Table table{
      "compare",
      "B " + b.string() + " against A " + a.string(),
      "",
      {"scenario", "pipeline", "seed", "metric", "subject", "verdict"},
      {{"", "A", false}, {"", "B", false}, {"", "B - A", false}, {"", "tolerance", false}, {"", "unit", false}},
      {}};
  for (const auto& row : comparison.rows) {
    const bool quiet = row.verdict == harness::Verdict::same || row.verdict == harness::Verdict::within ||
                       row.verdict == harness::Verdict::timing;
    if (quiet && !all) continue;
    table.rows.push_back({{row.cell.scenario, row.cell.pipeline, std::to_string(row.cell.seed), row.metric, row.subject,
                           std::string(to_string(row.verdict))},
                          {{shown(row.a)}, {shown(row.b)}, {shown(row.difference)}, {shown(row.tolerance)}, {row.unit}},
                          false});
  }
  for (const auto& note : comparison.notes) fmt::print("note: {}\n", note);
  if (!table.rows.empty()) fmt::print("{}\n", harness::to_terminal(table, use_color()));
  std::string counts;
  for (const auto& [verdict, count] : comparison.counts)
    counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", count, to_string(verdict));
  const bool worse = comparison.counts.contains(harness::Verdict::worse);
  fmt::print("{}{}{}\n", counts.empty() ? "nothing to compare" : counts, worse ? "; WORSE" : "",
             comparison.incomplete ? "; INCOMPLETE" : "");
  if (!csv.empty()) harness::write_file_atomically(csv, harness::comparison_csv(comparison));
  return comparison.exit_code();
}

}  // namespace

void add_results(Context& context) {
  struct Options {
    std::string run, other, csv;
    std::vector<std::string> files;
    bool pdf = false, quiet = false, all = false;
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

  auto* compare_verb = context.app.add_subcommand(
      "compare", "Compares two runs cell by cell; exit code 1 if B is worse, 4 if incomplete, 5 if both");
  compare_verb->add_option("A", options->run, "the run folder to compare with")->required();
  compare_verb->add_option("B", options->other, "the run folder that is judged")->required();
  compare_verb->add_option("--csv", options->csv, "write all rows to this file");
  compare_verb->add_flag("--all", options->all, "also show unchanged values");
  compare_verb->callback([&context, options] {
    context.action = [options] { return compare(options->run, options->other, options->csv, options->all); };
  });
}

}  // namespace scanbench::app
