// Runs tasks in child processes by fork(), with limits, pipes and signals.
#include "harness/run/worker.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <deque>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "harness/files/system_error.hpp"
#include "harness/foreign/confine.hpp"
#include "harness/foreign/output_tail.hpp"
#include "harness/run/descendants.hpp"
#include "harness/run/worker_report.hpp"

namespace scanbench::harness {
namespace {

constexpr std::size_t kTail = 4096;    // bytes kept of what a child prints
constexpr int kBlocksAtOnce = 64;      // read of one pipe before the others get their turn
constexpr double kKillDeadline = 5.0;  // seconds to wait for a killed child to end
constexpr int kInterrupts[] = {SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t interrupt_seen = 0;
bool pool_exists = false;  // signal handlers belong to the process: one pool at a time
std::array<struct sigaction, std::size(kInterrupts)> old_actions;
struct sigaction old_child_action;
sigset_t held;  // the interrupts that a pool handles
sigset_t old_mask;
double memory_kills = 0.0;        // that the kernel had made when a worker was last found killed
std::vector<pid_t> old_children;  // of this process when the pool was made

volatile std::sig_atomic_t sender_seen = 0;  // the child that an interrupt came from; 0: none did

/// An interrupt that a task or its descendant has sent is a fault of that task. Signals are delivered during ppoll()
/// only, so that reading files is safe here.
void note_interrupt(const siginfo_t& info) {
  const pid_t sender = info.si_code <= 0 ? branch_of(info.si_pid) : 0;
  if (sender > 0)
    sender_seen = sender;
  else if (interrupt_seen != SIGTERM)
    interrupt_seen = info.si_signo;
}

void on_interrupt(int, siginfo_t* info, void*) {
  note_interrupt(*info);
}

/// While pipes have bytes to read, ppoll() returns before it delivers a signal, so pending signals are taken here.
void take_pending_signals() {
  const timespec now{0, 0};
  siginfo_t info{};
  while (sigtimedwait(&held, &info, &now) > 0) note_interrupt(info);
}

bool run_is_terminated() {
  take_pending_signals();
  return interrupt_seen == SIGTERM;
}

/// True if the kernel has killed a process for want of memory that has not been accounted for yet.
bool system_killed_for_memory() {
  if (out_of_memory_kills() <= memory_kills) return false;
  ++memory_kills;
  return true;
}

double wall_seconds() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Reads the available bytes, up to a number of blocks, because a child may write without end. False at the end of the
/// pipe.
bool drain(int fd, std::string& text) {
  std::array<char, 1 << 14> block{};
  for (int i = 0; i < kBlocksAtOnce; ++i) {
    const ssize_t n = ::read(fd, block.data(), block.size());
    if (n > 0) {
      text.append(block.data(), static_cast<std::size_t>(n));
    } else if (n == 0) {
      return false;
    } else if (errno != EINTR) {
      return errno == EAGAIN;
    }
  }
  return true;
}

/// Kills a child and its process group. The child itself may have left that group.
void kill_child(pid_t pid) {
  ::kill(-pid, SIGKILL);
  ::kill(pid, SIGKILL);
}

bool has_ended(pid_t pid) {
  siginfo_t info{};  // the child remains until wait4(), so its process id is not used again before
  return ::waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == pid;
}

/// Waits for a killed child, but not forever: one that the kernel cannot end now must not delay the run.
void reap(pid_t pid) {
  const double deadline = wall_seconds() + kKillDeadline;
  while (::waitpid(pid, nullptr, WNOHANG) == 0 && wall_seconds() < deadline) {
    const timespec pause{0, 1000000};
    ::nanosleep(&pause, nullptr);
  }
}

}  // namespace

struct WorkerPool::Worker {
  struct Task {
    std::size_t id;
    double seconds;  ///< limit
  };

  std::deque<Task> tasks;  ///< the first runs
  pid_t pid;
  int report;
  int output;
  int end;  ///< a descriptor of the process, which is readable when it has ended; -1 if the kernel has none
  double start;
  bool killed_for_time = false;
  bool killed_for_report = false;
  bool killed_for_signal = false;
  bool report_open = true;
  bool output_open = true;
  double cpu_before = 0.0;  ///< seconds of earlier tasks
  std::string report_text = {};
  std::string output_text = {};

  std::size_t id() const { return tasks.front().id; }
  double seconds() const { return tasks.front().seconds; }
  bool is_late() const { return wall_seconds() > start + seconds(); }

  void close() const {
    ::close(report);
    ::close(output);
    if (end >= 0) ::close(end);
  }

  void read_pipes() {
    if (report_open) report_open = drain(report, report_text);
    if (output_open) output_open = drain(output, output_text);
    if (output_text.size() > 2 * kTail) output_text.erase(0, output_text.size() - kTail);
    if (report_text.size() > kLargestReport && !killed_for_report) {
      killed_for_report = true;
      report_open = false;
      kill_child(pid);
    }
  }

  bool was_killed() const { return killed_for_time || killed_for_report || killed_for_signal; }

  /// If the first of several tasks has ended well, the next one is running.
  std::optional<Finished> next_task() {
    if (tasks.size() < 2 || was_killed() || is_late()) return std::nullopt;
    std::string rest = report_text;
    std::optional<WorkerReport> taken = take_report(rest);
    if (!taken || taken->outcome.status != CellStatus::ok) return std::nullopt;
    const double now = wall_seconds();
    taken->outcome.wall_seconds = now - std::exchange(start, now);
    cpu_before += taken->outcome.cpu_seconds;
    report_text = std::move(rest);
    const std::size_t ended = id();
    tasks.pop_front();
    return Finished{ended, std::move(taken->outcome), std::move(taken->output)};
  }

  Finished last_task(int wait_status, const rusage& usage) {
    const auto seconds_of = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    WorkerReport last = report_of(wait_status);
    WorkerOutcome& result = last.outcome;
    result.wall_seconds = wall_seconds() - start;
    result.cpu_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime) - cpu_before;
    result.peak_memory_bytes = 1024.0 * static_cast<double>(usage.ru_maxrss);
    return {id(), std::move(last.outcome), std::move(last.output)};
  }

  WorkerReport report_of(int wait_status) {
    if (killed_for_report) return {{.message = "reported more than " + std::to_string(kLargestReport) + " bytes"}};
    if (killed_for_signal)
      return {{.status = CellStatus::crashed, .message = "sent a signal to this program, which is for the user to do"}};
    WorkerOutcome result;
    const bool exited = WIFEXITED(wait_status) && WEXITSTATUS(wait_status) == 0;
    std::optional<WorkerReport> reported = exited ? take_report(report_text) : std::nullopt;
    if (reported && is_late()) {
      // It ended before the parent saw that its time was over. Which comes first must not change the result.
      result.status = CellStatus::timeout;
      result.message = over_time();
    } else if (reported) {
      if (reported->outcome.status == CellStatus::ok) return std::move(*reported);
      result = std::move(reported->outcome);
      if (result.status == CellStatus::out_of_memory && result.message.empty())
        result.message = "an allocation failed under the memory limit";
    } else if (WIFSIGNALED(wait_status)) {
      describe_signal(WTERMSIG(wait_status), result);
    } else {
      result.status = CellStatus::crashed;
      result.message = "ended without a result, exit code " + std::to_string(WEXITSTATUS(wait_status));
    }
    if (!output_text.empty()) result.message += "\n" + output_tail(output_text);
    return {std::move(result)};
  }

  std::string over_time() const { return "took longer than the limit of " + number_text(seconds()) + " s"; }

  void describe_signal(int signal, WorkerOutcome& result) const {
    if (killed_for_time) {
      result.status = CellStatus::timeout;
      result.message = over_time();
    } else if (signal == SIGTERM && run_is_terminated()) {
      // A batch system sends it to every process of a job. The cell is then unfinished and not at fault.
      result.system_error = true;
      result.message = "stopped with the run";
    } else if (signal == SIGXCPU) {
      result.status = CellStatus::timeout;
      result.message = "used up the limit of CPU time";
    } else if (signal == SIGKILL && system_killed_for_memory()) {
      result.status = CellStatus::out_of_memory;
      result.message = "killed by the system, because memory ran out";
    } else {
      // A bad_alloc in a noexcept function ends in abort(), after say_out_of_memory() has written its line.
      const bool memory = output_text.find(kOutOfMemory) != std::string::npos;
      result.status = memory ? CellStatus::out_of_memory : CellStatus::crashed;
      result.message = "ended by signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
    }
  }
};

WorkerPool::WorkerPool() {
  SCANBENCH_ASSERT(!pool_exists);
  pool_exists = true;
  interrupt_seen = 0;
  sender_seen = 0;
  memory_kills = out_of_memory_kills();
  old_children = children();
  adopt_orphans();
  sigemptyset(&held);
  for (std::size_t i = 0; i < std::size(kInterrupts); ++i) {
    sigaction(kInterrupts[i], nullptr, &old_actions[i]);
    // `nohup` starts the program with SIGHUP ignored, which stays so.
    if (kInterrupts[i] == SIGHUP && old_actions[i].sa_handler == SIG_IGN) continue;
    struct sigaction action {};
    action.sa_sigaction = on_interrupt;
    action.sa_flags = SA_SIGINFO;
    sigaction(kInterrupts[i], &action, nullptr);
    sigaddset(&held, kInterrupts[i]);
  }
  // If SIGCHLD is ignored, which a parent may have set, ended children vanish and cannot be waited for.
  struct sigaction standard {};
  standard.sa_handler = SIG_DFL;
  sigaction(SIGCHLD, &standard, &old_child_action);
  sigprocmask(SIG_BLOCK, &held, &old_mask);
}

WorkerPool::~WorkerPool() {
  kill_all();
  sigprocmask(SIG_SETMASK, &old_mask, nullptr);
  for (std::size_t i = 0; i < std::size(kInterrupts); ++i) sigaction(kInterrupts[i], &old_actions[i], nullptr);
  sigaction(SIGCHLD, &old_child_action, nullptr);
  pool_exists = false;
}

std::size_t WorkerPool::running() const {
  return workers_.size();
}

bool WorkerPool::interrupted() const {  // NOLINT(*-convert-member-functions-to-static)
  take_pending_signals();
  return interrupt_seen != 0;
}

bool WorkerPool::terminated() const {  // NOLINT(*-convert-member-functions-to-static)
  return run_is_terminated();
}

void WorkerPool::start(std::size_t id, const std::function<TaskOutput()>& task, const WorkerLimits& limits) {
  start({{id, task, limits}});
}

void WorkerPool::start(const std::vector<WorkerTask>& tasks) {
  SCANBENCH_ASSERT(!tasks.empty());
  int report[2];
  int output[2];
  if (::pipe2(report, O_CLOEXEC) != 0) throw SystemError(std::string("cannot start a worker: ") + std::strerror(errno));
  if (::pipe2(output, O_CLOEXEC) != 0) {
    ::close(report[0]);
    ::close(report[1]);
    throw SystemError(std::string("cannot start a worker: ") + std::strerror(errno));
  }
  std::fflush(nullptr);  // or the child would print the parent's buffers again
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid == 0) live_as_child(tasks, {parent, report[1], output[1], held, old_mask});
  ::close(report[1]);
  ::close(output[1]);
  if (pid < 0) {
    ::close(report[0]);
    ::close(output[0]);
    throw SystemError(std::string("cannot start a worker: ") + std::strerror(errno));
  }
  setpgid(pid, pid);  // called in both processes, because either may be the first
  fcntl(report[0], F_SETFL, O_NONBLOCK);
  fcntl(output[0], F_SETFL, O_NONBLOCK);
  Worker worker{.tasks = {},
                .pid = pid,
                .report = report[0],
                .output = output[0],
                .end = static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)),
                .start = wall_seconds()};
  for (const WorkerTask& task : tasks) worker.tasks.push_back({task.id, task.limits.seconds});
  workers_.push_back(std::move(worker));
}

/// Ends what a worker has left in sessions of their own, and removes its group of limits.
void WorkerPool::end_descendants(pid_t ended) const {
  std::vector<pid_t> spared = old_children;
  for (const auto& w : workers_)
    if (w.pid != ended) spared.push_back(w.pid);
  kill_orphans(spared);
  remove_confinement(ended);
}

std::vector<WorkerPool::Finished> WorkerPool::wait() {
  std::vector<Finished> finished;
  while (finished.empty() && !workers_.empty() && !interrupted())
    finished = poll_once(std::numeric_limits<double>::infinity());
  return finished;
}

std::vector<WorkerPool::Finished> WorkerPool::wait_despite_interrupts(double seconds) {
  std::vector<Finished> finished;
  const double end = wall_seconds() + seconds;
  while (finished.empty() && !workers_.empty() && wall_seconds() < end) finished = poll_once(end - wall_seconds());
  return finished;
}

/// Waits for an event, reads the pipes, kills children whose time is over, and collects those that have ended.
std::vector<WorkerPool::Finished> WorkerPool::poll_once(double longest_pause) {
  std::vector<Finished> finished;
  std::vector<pollfd> fds;
  // Before Linux 5.3, no event reports the end of a child while a process that it started holds its pipes.
  double pause = std::min(longest_pause, 0.02);
  for (const auto& w : workers_) {
    if (w.report_open) fds.push_back({w.report, POLLIN, 0});
    if (w.output_open) fds.push_back({w.output, POLLIN, 0});
    if (w.end >= 0) fds.push_back({w.end, POLLIN, 0});
    // A closed report means that the child ends soon, without anything left to poll.
    pause = std::min(pause, w.report_open && !w.killed_for_time ? w.start + w.seconds() - wall_seconds() : 1e-3);
  }
  pause = std::max(pause, 0.0);
  const timespec timeout{static_cast<time_t>(pause), static_cast<long>(1e9 * (pause - std::floor(pause)))};
  ::ppoll(fds.data(), fds.size(), &timeout, &old_mask);  // the only place where signals are delivered

  for (std::size_t i = 0; i < workers_.size();) {
    Worker& w = workers_[i];
    w.read_pipes();
    if (w.pid == sender_seen && !w.killed_for_signal) {
      w.killed_for_signal = true;
      kill_child(w.pid);
    }
    while (auto ended = w.next_task()) finished.push_back(std::move(*ended));
    if (!w.killed_for_time && w.is_late()) {
      w.killed_for_time = true;
      kill_child(w.pid);
    }
    if (!has_ended(w.pid)) {
      ++i;
      continue;
    }
    ::kill(-w.pid, SIGKILL);  // processes that the task may have started
    w.read_pipes();           // the rest, which is less than one read takes
    while (auto ended = w.next_task()) finished.push_back(std::move(*ended));
    int status = 0;
    rusage usage{};
    ::wait4(w.pid, &status, 0, &usage);
    end_descendants(w.pid);
    w.close();
    finished.push_back(w.last_task(status, usage));
    workers_.erase(workers_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return finished;
}

void WorkerPool::kill_all() {
  for (const auto& w : workers_) kill_child(w.pid);
  for (const auto& w : workers_) {
    reap(w.pid);
    remove_confinement(w.pid);
    w.close();
  }
  if (!workers_.empty()) kill_orphans(old_children);
  workers_.clear();
}

}  // namespace scanbench::harness
