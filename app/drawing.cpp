// One child draws all figures: it may take ten times as long as all cells, and the memory of the largest.
#include "app/drawing.hpp"

#include <cstdlib>

#include <algorithm>
#include <cstddef>

#include "core/error.hpp"
#include "harness/page/plain_text.hpp"
#include "harness/report/run_report.hpp"
#include "harness/run/worker.hpp"
#include "harness/store/cell_status.hpp"

namespace scanbench::app {
namespace {

constexpr int kRendererThreads = 2;  // of OSMesa: each needs address space

}  // namespace

std::string draw_within_limits(const std::filesystem::path& run, const std::vector<harness::Scenario>& scenarios,
                               const harness::FigureOptions& options, Progress& progress) {
  harness::WorkerLimits limits{.seconds = 0.0, .memory_bytes = 0.0, .threads = kRendererThreads + 1};
  for (const auto& scenario : scenarios) {
    const std::size_t cells = std::max<std::size_t>(1, scenario.pipelines.size() * scenario.seeds.size());
    limits.seconds += 10.0 * scenario.limits.seconds * static_cast<double>(cells);
    limits.memory_bytes = std::max(limits.memory_bytes, scenario.limits.memory_bytes);
  }
  progress.update(0.95, "figures");
  harness::WorkerOutcome outcome;
  {
    harness::WorkerPool pool;
    const auto draw = [&] {
      setenv("LP_NUM_THREADS", std::to_string(kRendererThreads).c_str(), 0);  // pictures do not depend on it
      harness::draw_run_figures(run, scenarios, options);
      return std::string();
    };
    pool.start(0, draw, limits);
    const auto finished = pool.wait();
    if (pool.interrupted()) throw Interrupted{};
    outcome = finished.front().outcome;
  }
  if (outcome.status == harness::CellStatus::ok) return "";
  if (outcome.bad_input || outcome.system_error) throw ConfigError(outcome.message);
  if (options.folder.empty()) harness::save_figure_index(run / "figures", {});
  return "the figures were not drawn: " + std::string(to_string(outcome.status)) + ": " +
         harness::plain_line(outcome.message);
}

}  // namespace scanbench::app
