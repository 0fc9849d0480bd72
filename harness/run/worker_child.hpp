// The life of a child process: it keeps only its pipes, sets its limits, runs its tasks and reports each.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include <csignal>

#include <sys/types.h>

#include "harness/run/worker_report.hpp"

namespace scanbench::harness {

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

/// What a child takes over from its parent.
struct ChildSetting {
  pid_t parent = 0;
  int report = -1;       ///< the pipe for reports
  int output = -1;       ///< the pipe for what the tasks print
  sigset_t defaulted{};  ///< signals that get their default action
  sigset_t mask{};       ///< the signal mask that the tasks have
};

/// Runs the tasks one after another, as a process group of its own, and ends the process. Writes a report
/// (worker_report.hpp) after each. The first task that is not ok is the last.
[[noreturn]] void live_as_child(std::span<const WorkerTask> tasks, const ChildSetting& setting);

}  // namespace scanbench::harness
