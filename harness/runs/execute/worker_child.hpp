// The tasks of a child process: it sets the limits of each, runs it and reports it.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "harness/runs/execute/worker_report.hpp"

namespace scanbench::runs {

struct WorkerLimits {
  double seconds = 600.0;     ///< wall time
  double memory_bytes = 4e9;  ///< address space beyond what is used when the task begins; no limit under sanitizers
  int threads = 1;            ///< the task may start this many
};

struct WorkerTask {
  std::size_t id = 0;
  std::function<TaskOutput()> work;  ///< returns what the parent gets
  WorkerLimits limits;
};

/// What a child writes to stderr when memory runs out: a std::bad_alloc that nothing catches ends in abort().
inline constexpr std::string_view kOutOfMemory = "an allocation failed (std::bad_alloc)\n";

/// Runs the tasks one after another, in a child process that leads its group. Writes a report (worker_report.hpp) to
/// the descriptor `report` after each. The first task that is not ok is the last.
void perform_in_child(std::span<const WorkerTask> tasks, int report);

}  // namespace scanbench::runs
