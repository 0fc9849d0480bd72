// Runs tasks in child processes with limits.
#include "harness/runs/execute/worker.hpp"

#include <algorithm>
#include <csignal>
#include <deque>
#include <limits>
#include <optional>
#include <system_error>
#include <utility>

#include <poll.h>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "harness/io/files/system_error.hpp"
#include "harness/io/process/child.hpp"
#include "harness/io/process/deadline.hpp"
#include "harness/io/process/descendants.hpp"
#include "harness/io/process/output_tail.hpp"
#include "harness/io/process/pipe.hpp"
#include "harness/runs/execute/worker_report.hpp"
#include "harness/study/foreign/confine.hpp"

namespace scanbench::runs {
namespace {

double memory_kills = 0.0;  // that the kernel had made when a worker was last found killed

/// True if the kernel has killed a process for want of memory that has not been accounted for yet.
bool system_killed_for_memory() {
  if (io::out_of_memory_kills() <= memory_kills) return false;
  ++memory_kills;
  return true;
}

}  // namespace

struct WorkerPool::Worker {
  struct Task {
    std::size_t id;
    double seconds;  ///< limit
  };

  std::deque<Task> tasks;  ///< the first runs
  io::Child child;
  io::PipeReader report;
  io::PipeReader output;
  double start;  ///< of the first task, on the monotonic clock
  bool killed_for_time = false;
  bool killed_for_report = false;
  bool killed_for_signal = false;
  double cpu_before = 0.0;  ///< seconds of earlier tasks

  std::size_t id() const { return tasks.front().id; }
  double seconds() const { return tasks.front().seconds; }
  double seconds_left() const { return start + seconds() - io::monotonic_seconds(); }
  bool is_late() const { return seconds_left() < 0.0; }

  void read_pipes() {
    report.drain();
    output.drain();
    if (report.bytes().size() > kLargestReport && !killed_for_report) {
      killed_for_report = true;
      report.close();
      child.kill();
    }
  }

  bool was_killed() const { return killed_for_time || killed_for_report || killed_for_signal; }

  /// If the first of several tasks has ended well, the next one is running.
  std::optional<Finished> next_task() {
    if (tasks.size() < 2 || was_killed() || is_late()) return std::nullopt;
    std::string rest = report.bytes();
    std::optional<WorkerReport> taken = take_report(rest);
    if (!taken || taken->outcome.status != CellStatus::ok) return std::nullopt;
    const double now = io::monotonic_seconds();
    taken->outcome.wall_seconds = now - std::exchange(start, now);
    cpu_before += taken->outcome.cpu_seconds;
    report.bytes() = std::move(rest);
    const std::size_t ended = id();
    tasks.pop_front();
    return Finished{ended, std::move(taken->outcome), std::move(taken->output)};
  }

  Finished last_task(const io::ProcessEnd& end) {
    WorkerReport last = report_of(end);
    WorkerOutcome& result = last.outcome;
    result.wall_seconds = io::monotonic_seconds() - start;
    result.cpu_seconds = end.usage.cpu_seconds - cpu_before;
    result.peak_memory_bytes = end.usage.peak_memory_bytes;
    return {id(), std::move(last.outcome), std::move(last.output)};
  }

  WorkerReport report_of(const io::ProcessEnd& end) {
    if (killed_for_report) return {{.message = "reported more than " + std::to_string(kLargestReport) + " bytes"}};
    if (killed_for_signal) return {{.status = CellStatus::crashed, .message = "sent a signal to scanbench itself"}};
    WorkerOutcome result;
    std::optional<WorkerReport> reported = end.is_success() ? take_report(report.bytes()) : std::nullopt;
    if (reported && is_late()) {
      // It ended before the parent saw that its time was over. Which comes first must not change the result.
      result.status = CellStatus::timeout;
      result.message = over_time();
    } else if (reported) {
      if (reported->outcome.status == CellStatus::ok) return std::move(*reported);
      result = std::move(reported->outcome);
      if (result.status == CellStatus::out_of_memory && result.message.empty())
        result.message = "an allocation failed under the memory limit";
    } else if (end.signal != 0) {
      describe_signal(end, result);
    } else {
      result.status = CellStatus::crashed;
      result.message = "ended without a result, exit code " + std::to_string(end.exit_code);
    }
    if (!output.bytes().empty()) result.message += "\n" + io::output_tail(output.bytes());
    return {std::move(result)};
  }

  std::string over_time() const { return "took longer than the limit of " + number_text(seconds()) + " s"; }

  void describe_signal(const io::ProcessEnd& end, WorkerOutcome& result) const {
    if (killed_for_time) {
      result.status = CellStatus::timeout;
      result.message = over_time();
    } else if (end.signal == SIGTERM && io::InterruptWatch::signal() == SIGTERM) {
      // A batch system sends it to every process of a job. The cell is then unfinished and not at fault.
      result.system_error = true;
      result.message = "stopped with the run";
    } else if (end.signal == SIGXCPU) {
      result.status = CellStatus::timeout;
      result.message = "used up the limit of CPU time";
    } else if (end.signal == SIGKILL && system_killed_for_memory()) {
      result.status = CellStatus::out_of_memory;
      result.message = "killed by the system, because memory ran out";
    } else {
      // A bad_alloc in a noexcept function ends in abort(), after say_out_of_memory() has written its line.
      const bool memory = output.bytes().find(kOutOfMemory) != std::string::npos;
      result.status = memory ? CellStatus::out_of_memory : CellStatus::crashed;
      result.message = "ended " + io::to_text(end);
    }
  }
};

WorkerPool::WorkerPool() : old_children_(io::children()) {
  memory_kills = io::out_of_memory_kills();
  io::adopt_orphans();
}

WorkerPool::~WorkerPool() {
  kill_all();
}

std::size_t WorkerPool::running() const {
  return workers_.size();
}

bool WorkerPool::interrupted() const {  // NOLINT(*-convert-member-functions-to-static)
  return io::InterruptWatch::signal() != 0;
}

bool WorkerPool::terminated() const {  // NOLINT(*-convert-member-functions-to-static)
  return io::InterruptWatch::signal() == SIGTERM;
}

void WorkerPool::start(std::size_t id, const std::function<TaskOutput()>& task, const WorkerLimits& limits) {
  start({{id, task, limits}});
}

void WorkerPool::start(const std::vector<WorkerTask>& tasks) {
  SCANBENCH_ASSERT(!tasks.empty());
  try {
    io::Pipe report = io::make_pipe();
    io::Pipe output = io::make_pipe();
    const io::ChildSetting setting{.output = output.write_end.number(),
                                   .errors = output.write_end.number(),
                                   .channel = report.write_end.number(),
                                   .own_group = true};
    io::Child child = io::start_child(setting, [&] {
      io::InterruptWatch::end_in_child();
      perform_in_child(tasks, io::kChannel);
      return 0;
    });
    Worker worker{.tasks = {},
                  .child = std::move(child),
                  .report = {std::move(report.read_end), kLargestReport},
                  .output = {std::move(output.read_end), io::kOutputKept},
                  .start = io::monotonic_seconds()};
    for (const WorkerTask& task : tasks) worker.tasks.push_back({task.id, task.limits.seconds});
    workers_.push_back(std::move(worker));
  } catch (const std::system_error& error) {
    throw io::SystemError("cannot start a worker: " + error.code().message());
  }
}

/// Ends what a worker has left in sessions of their own, and removes its group of limits.
void WorkerPool::end_descendants(pid_t ended) const {
  std::vector<pid_t> spared = old_children_;
  for (const auto& w : workers_)
    if (w.child.pid() != ended) spared.push_back(w.child.pid());
  io::kill_orphans(spared);
  study::remove_confinement(ended);
}

std::vector<WorkerPool::Finished> WorkerPool::wait() {
  std::vector<Finished> finished;
  while (finished.empty() && !workers_.empty() && !interrupted())
    finished = poll_once(std::numeric_limits<double>::infinity());
  return finished;
}

std::vector<WorkerPool::Finished> WorkerPool::wait_despite_interrupts(double seconds) {
  std::vector<Finished> finished;
  const io::Deadline deadline(seconds);
  while (finished.empty() && !workers_.empty() && !deadline.is_over()) finished = poll_once(deadline.seconds_left());
  return finished;
}

/// Waits for an event, reads the pipes, kills children whose time is over, and collects those that have ended.
std::vector<WorkerPool::Finished> WorkerPool::poll_once(double longest_pause) {
  std::vector<Finished> finished;
  std::vector<pollfd> fds;
  // Before Linux 5.3, no event reports the end of a child while a process that it started holds its pipes.
  double pause = std::min(longest_pause, 0.02);
  for (const auto& w : workers_) {
    for (const int descriptor : {w.report.descriptor(), w.output.descriptor(), w.child.end_descriptor()})
      fds.push_back({descriptor, POLLIN, 0});
    // A closed report means that the child ends soon, without anything left to poll.
    pause = std::min(pause, w.report.is_open() && !w.killed_for_time ? w.seconds_left() : 1e-3);
  }
  io::wait_for_events(fds, pause, &io::InterruptWatch::outer_mask());  // the only place where signals are delivered

  for (std::size_t i = 0; i < workers_.size();) {
    Worker& w = workers_[i];
    w.read_pipes();
    if (w.child.pid() == io::InterruptWatch::sender() && !w.killed_for_signal) {
      w.killed_for_signal = true;
      w.child.kill();
    }
    while (auto ended = w.next_task()) finished.push_back(std::move(*ended));
    if (!w.killed_for_time && w.is_late()) {
      w.killed_for_time = true;
      w.child.kill();
    }
    if (!w.child.has_ended()) {
      ++i;
      continue;
    }
    const io::ProcessEnd& end = w.child.reap();
    w.read_pipes();  // the rest, which is less than one read takes
    while (auto ended = w.next_task()) finished.push_back(std::move(*ended));
    end_descendants(w.child.pid());
    finished.push_back(w.last_task(end));
    workers_.erase(workers_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return finished;
}

void WorkerPool::kill_all() {
  for (const auto& w : workers_) w.child.kill();
  for (auto& w : workers_) {
    w.child.end();
    study::remove_confinement(w.child.pid());
  }
  if (!workers_.empty()) io::kill_orphans(old_children_);
  workers_.clear();
}

}  // namespace scanbench::runs
