// What a run would do, before it does it: cells, rays, bytes, seconds.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "harness/runs/execute/run_options.hpp"
#include "harness/study/scenario/scenario.hpp"

namespace scanbench::runs {

struct ScenarioForecast {
  std::string scenario;
  std::size_t cells = 0;            ///< those that are selected
  std::size_t scans = 0;            ///< of one recording
  double rays = 0.0;                ///< readings of all recordings
  double bytes = 0.0;               ///< of recordings and cells; figures and report come on top
  double seconds = 0.0;             ///< of work, before jobs share it
  std::size_t sample = 0;           ///< scans that the estimate rests on
  bool in_proportion = true;        ///< false: a pipeline has a slot whose work grows faster than the number of scans
  std::vector<std::string> faults;  ///< pipelines that are not ok on the sample: "iepf: crashed: ..."
};

struct Forecast {
  std::vector<ScenarioForecast> scenarios;
  bool interrupted = false;
};

/// Runs every selected pipeline on a few scans of each scenario, twice with different numbers of them, in a temporary
/// folder, and extends the line through the two results to all scans and seeds: bytes and seconds are estimates, cells
/// and rays exact. Nothing is reused and nothing remains. `options.progress` hears of the share that is done. Must be
/// called while the process has one thread. Throws what plan_run(), make_recording() and run_with() throw.
Forecast forecast_run(const std::vector<study::Scenario>& scenarios, const RunOptions& options);

}  // namespace scanbench::runs
