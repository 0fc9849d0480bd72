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
  std::size_t sample = 0;           ///< scans that were tried of this scenario; 0: it is taken to be like others
  bool in_proportion = true;        ///< false: a pipeline has a slot whose work grows faster than the number of scans
  std::vector<std::string> faults;  ///< pipelines that are not ok on the sample: "iepf: crashed: ..."
};

struct Forecast {
  std::vector<ScenarioForecast> scenarios;
  std::size_t tried = 0;    ///< scenarios of which scans were tried
  std::size_t cut_off = 0;  ///< pipelines of which no trial ended in time: they take at least what is foretold
  bool interrupted = false;
};

/// How long forecast_run() tries cells; reading logs comes on top.
inline constexpr double kForecastSeconds = 3.5;

/// Cells and rays are exact. For bytes and seconds, pipelines run on 2 scans of a scenario, those that are fast enough
/// also on 12, in a temporary folder, and the line through the two results is extended to all scans and seeds.
/// Scenarios are tried for kForecastSeconds: first one of each set of pipelines, then more that are spread over the
/// list. A scenario that was not tried is taken to be like those of its pipelines with the nearest number of beams.
/// Nothing is reused and nothing remains. `options.progress` hears of the share that is done. Must be called while the
/// process has one thread. Throws what plan_run(), make_recording() and simulate() throw.
Forecast forecast_run(const std::vector<study::Scenario>& scenarios, const RunOptions& options);

}  // namespace scanbench::runs
