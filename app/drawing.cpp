// One child draws all figures: it may take ten times as long as all cells, and the memory of the largest.
#include "app/drawing.hpp"

#include <cstdlib>

#include <algorithm>
#include <cstddef>

#include "core/error.hpp"
#include "harness/results/document/plain_text.hpp"
#include "harness/results/pages/run_report.hpp"
#include "harness/runs/execute/worker.hpp"
#include "harness/runs/store/cell_status.hpp"

namespace scanbench::app {
namespace {

constexpr int kRendererThreads = 2;  // of OSMesa: each needs address space

}  // namespace

std::string draw_within_limits(const std::filesystem::path& run, const std::vector<study::Scenario>& scenarios,
                               const results::FigureOptions& options, Progress& progress) {
  runs::WorkerLimits limits{.seconds = 0.0, .memory_bytes = 0.0, .threads = kRendererThreads + 1};
  for (const auto& scenario : scenarios) {
    const std::size_t cells = std::max<std::size_t>(1, scenario.pipelines.size() * scenario.seeds.size());
    limits.seconds += 10.0 * scenario.limits.seconds * static_cast<double>(cells);
    limits.memory_bytes = std::max(limits.memory_bytes, scenario.limits.memory_bytes);
  }
  progress.update(0.95, "figures");
  runs::WorkerOutcome outcome;
  {
    runs::WorkerPool pool;
    const auto draw = [&] {
      setenv("LP_NUM_THREADS", std::to_string(kRendererThreads).c_str(), 0);  // pictures do not depend on it
      results::draw_run_figures(run, scenarios, options);
      return std::string();
    };
    pool.start(0, draw, limits);
    const auto finished = pool.wait();
    if (pool.interrupted()) throw Interrupted{};
    outcome = finished.front().outcome;
  }
  if (outcome.status == runs::CellStatus::ok) return "";
  if (outcome.bad_input || outcome.system_error) throw ConfigError(outcome.message);
  if (options.folder.empty()) results::save_figure_index(run / "figures", {});
  return "the figures were not drawn: " + std::string(to_string(outcome.status)) + ": " +
         results::plain_line(outcome.message);
}

}  // namespace scanbench::app
