// Child processes with limits: a crash, a hang or excessive memory use is an outcome of a cell and does not end the
// run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <sys/types.h>

#include "harness/io/process/interrupts.hpp"
#include "harness/runs/execute/worker_child.hpp"
#include "harness/runs/execute/worker_report.hpp"
#include "harness/runs/store/cell_status.hpp"

namespace scanbench::runs {

/// Runs tasks in forked children. The parent must have one thread only when start() is called. While a pool exists,
/// SIGINT, SIGTERM and SIGHUP are blocked and seen only by wait(). Each child is a process group of its own, so that an
/// interrupt at the terminal reaches the parent alone; it has an empty standard input and none of the parent's open
/// files; it is killed when the parent ends. Processes that a child has started are killed with it, even in sessions of
/// their own: the process that has a pool adopts orphans. An interrupt that a child sends is a fault of that child. One
/// pool may exist at a time.
class WorkerPool {
 public:
  WorkerPool();
  ~WorkerPool();  ///< kills children that still run
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  struct Finished {
    std::size_t id = 0;
    WorkerOutcome outcome;
    TaskOutput output{};  ///< without its message, which the outcome has
  };

  /// Forks. In the child the task runs, its result goes through a pipe, and the process ends without destructors of the
  /// parent's objects. A result of more than kLargestReport bytes is a failure. Throws SystemError if the system
  /// refuses another process.
  void start(std::size_t id, const std::function<TaskOutput()>& task, const WorkerLimits& limits);
  /// Runs the tasks one after another in one child, which saves forks where the next task needs what the one before it
  /// has in memory. Each has its own limits and its own outcome. A task that is not ok ends the child: those after it
  /// have no outcome.
  void start(const std::vector<WorkerTask>& tasks);
  std::size_t running() const;
  /// Blocks until a child has ended, or an interrupt: then interrupted() is true and the list may be empty.
  std::vector<Finished> wait();
  /// Blocks until a child has ended or the time is over, whatever interrupts come.
  std::vector<Finished> wait_despite_interrupts(double seconds);
  // Members, because signals are watched while a pool exists.
  bool interrupted() const;  // NOLINT(*-convert-member-functions-to-static)
  bool terminated() const;   // NOLINT(*-convert-member-functions-to-static): interrupted by SIGTERM
  void kill_all();

 private:
  void end_descendants(pid_t ended) const;

  struct Worker;
  std::vector<Finished> poll_once(double longest_pause);
  io::InterruptWatch interrupts_;
  std::vector<pid_t> old_children_;  ///< of this process when the pool was made
  std::vector<Worker> workers_;
};

}  // namespace scanbench::runs
