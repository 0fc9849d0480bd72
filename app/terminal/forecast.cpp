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
namespace {

/// What the estimate rests on, and how it may be wrong.
std::string basis_text(const runs::Forecast& forecast, bool in_proportion) {
  std::size_t sample = 0;
  for (const auto& scenario : forecast.scenarios) sample = std::max(sample, scenario.sample);
  const std::size_t all = forecast.scenarios.size();
  std::string text =
      fmt::format("Bytes and time are estimated from up to {} of {}", counted(sample, "scan"),
                  forecast.tried == all ? (all == 1 ? "the scenario" : "each scenario")
                                        : fmt::format("{} of {} scenarios, which the others are taken to "
                                                      "be like",
                                                      forecast.tried, all));
  if (forecast.cut_off > 0)
    text += fmt::format("; {} did not end on them within the {:.2g} s of the trial",
                        counted(forecast.cut_off, "pipeline"), runs::kForecastSeconds);
  if (!in_proportion) text += " (align, map and merge can take far more: their work grows faster than the scans)";
  return text;
}

}  // namespace

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
    for (const auto& fault : scenario.faults)
      fmt::print("note: on {} of {}, {}\n", counted(scenario.sample, "scan"), scenario.scenario,
                 results::plain_line(fault));
  }
  if (forecast.scenarios.size() > 1) row("all", total);
  fmt::print("{}", results::to_terminal(table, use_color()));
  const auto jobs =
      std::min<std::size_t>(static_cast<std::size_t>(options.jobs), std::max<std::size_t>(total.cells, 1));
  fmt::print("{} {} with {}, and {} in {}, without figures and report. {}; nothing has been written.\n",
             forecast.cut_off > 0 ? "At least" : "About", duration_text(total.seconds / static_cast<double>(jobs)),
             counted(jobs, "job"), io::size_text(total.bytes), options.out.string(),
             basis_text(forecast, in_proportion));
  return kGood;
}

}  // namespace scanbench::app
