// Computes the exit code of a run.
#include "harness/runs/execute/run_options.hpp"

#include <algorithm>

#include "harness/runs/store/cell_status.hpp"

namespace scanbench::runs {

int RunResult::exit_code() const {
  if (interrupted) return 130;
  if (std::ranges::any_of(cells, [](const CellResult& c) { return !c.done; })) return 4;
  if (std::ranges::any_of(cells, [](const CellResult& c) { return c.record.outcome.status != CellStatus::ok; }))
    return 3;
  return 0;
}

}  // namespace scanbench::runs
