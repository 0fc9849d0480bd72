// The verbs score and report, which work on existing run folders.
#include "app/verbs/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/inputs.hpp"
#include "app/terminal/progress.hpp"
#include "core/error.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/results/pages/run_report.hpp"
#include "harness/results/player/player_page.hpp"
#include "harness/runs/execute/runner.hpp"
#include "harness/runs/execute/score.hpp"
#include "harness/runs/store/archived_run.hpp"
#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "harness/runs/store/run_lock.hpp"
#include "harness/runs/store/run_scenarios.hpp"
#include "harness/runs/store/run_store.hpp"

namespace scanbench::app {
namespace {

namespace fs = std::filesystem;

int score(const fs::path& run, const std::vector<std::string>& files, bool quiet) {
  const auto scenarios = scenarios_for(run, files);
  const runs::RunLock lock(run);
  runs::refuse_linked_folders(run);
  const InterruptGuard guard;
  Progress progress(progress_style(quiet));
  const std::size_t cells = runs::score_run(
      run, scenarios, [&](double share, const std::string& what) { progress.update(share, "score " + what); });
  progress.finish();
  results::write_reports(run, results::load_report_input(run, scenarios));
  if (!quiet) fmt::print("{} scored: {}\n", counted(cells, "cell"), (run / runs::kSummaryFile).string());
  const runs::RunStore store(run);
  const auto planned = store.keys();
  const auto missing = std::ranges::count_if(planned, [&](const auto& key) { return !store.record(key); });
  if (missing == 0) return kGood;
  fmt::print("INCOMPLETE: {} of {} cells are missing\n", missing, planned.size());
  return kIncomplete;
}

int report(const fs::path& run, bool scans) {
  const auto scenarios = scenarios_for(run, {});
  const runs::RunLock lock(run);
  runs::refuse_linked_folders(run);
  // The report links to the player, which is therefore written first.
  if (scans) io::write_file_atomically(run / results::kPlayerPage, results::player_page(run, scenarios));
  results::write_reports(run, results::load_report_input(run, scenarios));
  fmt::print("{}\n{}\n", (run / results::kReportPage).string(), (run / results::kReportMarkdown).string());
  if (scans) fmt::print("{}\n", (run / results::kPlayerPage).string());
  return kGood;
}

struct ScoreOptions {
  std::string run;
  std::vector<std::string> files;
  bool quiet = false;
};

struct ReportVerbOptions {
  std::string run;
  bool scans = false;
};

}  // namespace

void add_score(CommandLine& line) {
  auto options = std::make_shared<ScoreOptions>();
  Verb verb = line.add_verb("score", "Computes the metrics of a run again, from its files");
  verb.option("RUN", options->run, "a run folder").required();
  verb.option("--with", options->files, "scenario files whose metrics replace the run's own");
  verb.flag("-q,--quiet", options->quiet, "print only errors and missing cells");
  verb.runs([options] { return score(options->run, options->files, options->quiet); });
}

void add_report(CommandLine& line) {
  auto options = std::make_shared<ReportVerbOptions>();
  Verb verb =
      line.add_verb("report", "Writes report.html and report.md of a run again, and a page that plays its scans");
  verb.option("RUN", options->run, "a run folder").required();
  verb.flag("--scans", options->scans,
            "also scans.html, a page that plays the scans with the lines found in them, in order or worst "
            "first; it holds at most 2000 scans of a recording and 24 MiB");
  verb.runs([options] { return report(options->run, options->scans); });
}

}  // namespace scanbench::app
