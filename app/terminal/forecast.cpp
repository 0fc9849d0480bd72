// The table of a forecast.
#include "app/terminal/forecast.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/exit_code.hpp"
#include "app/terminal/progress.hpp"
#include "harness/io/files/size_text.hpp"
#include "harness/results/document/plain_text.hpp"
#include "harness/results/document/table.hpp"
#include "harness/runs/execute/forecast.hpp"

namespace scanbench::app {

int print_forecast(const std::vector<study::Scenario>& scenarios, const runs::RunOptions& options, bool quiet) {
  Progress progress(progress_style(quiet));
  runs::RunOptions trial = options;
  trial.progress = [&](const runs::RunProgress& now) {
    progress.update(static_cast<double>(now.done) / static_cast<double>(std::max<std::size_t>(now.total, 1)), now.what);
  };
  const runs::Forecast forecast = runs::forecast_run(scenarios, trial);
  progress.finish();
  if (forecast.interrupted) return kInterrupted;

  results::Table table{"dry run",
                       "What this run would do",
                       "",
                       {"scenario"},
                       {{"", "cells", false}, {"", "rays", false}, {"", "bytes", false}, {"", "time", false}},
                       {}};
  runs::ScenarioForecast total;
  bool in_proportion = true;
  std::size_t sample = 0;
  const auto row = [&](const std::string& name, const runs::ScenarioForecast& f) {
    table.rows.push_back({{name},
                          {{std::to_string(f.cells)},
                           {fmt::format("{:.0f}", f.rays)},
                           {io::size_text(f.bytes)},
                           {duration_text(f.seconds)}},
                          false});
  };
  for (const auto& scenario : forecast.scenarios) {
    row(scenario.scenario, scenario);
    total.cells += scenario.cells;
    total.rays += scenario.rays;
    total.bytes += scenario.bytes;
    total.seconds += scenario.seconds;
    in_proportion = in_proportion && scenario.in_proportion;
    sample = std::max(sample, scenario.sample);
    for (const auto& fault : scenario.faults)
      fmt::print("note: on {} scans of {}, {}\n", scenario.sample, scenario.scenario, results::plain_line(fault));
  }
  if (forecast.scenarios.size() > 1) row("all", total);
  fmt::print("{}", results::to_terminal(table, use_color()));
  const auto jobs =
      std::min<std::size_t>(static_cast<std::size_t>(options.jobs), std::max<std::size_t>(total.cells, 1));
  fmt::print(
      "About {} with {}, and {} in {}, without figures and report. Bytes and time are estimated from {} scans "
      "of each scenario{}; nothing has been written.\n",
      duration_text(total.seconds / static_cast<double>(jobs)), counted(jobs, "job"), io::size_text(total.bytes),
      options.out.string(), sample,
      in_proportion ? "" : " (align, map and merge can take far more: their work grows faster than the scans)");
  return kGood;
}

}  // namespace scanbench::app
