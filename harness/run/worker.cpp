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
#include <exception>
#include <filesystem>
#include <iterator>
#include <limits>
#include <new>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "harness/files/atomic_file.hpp"
#include "harness/files/system_error.hpp"
#include "harness/foreign/confine.hpp"
#include "harness/foreign/fault.hpp"
#include "harness/foreign/output_tail.hpp"
#include "harness/run/descendants.hpp"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SCANBENCH_UNDER_SANITIZER 1
#else
#define SCANBENCH_UNDER_SANITIZER 0
#endif

namespace scanbench::harness {
namespace {

constexpr std::size_t kTail = 4096;                            // bytes kept of what a child prints
constexpr std::size_t kMessageLimit = std::size_t{16} * 1024;  // bytes kept of an exception's message
constexpr std::size_t kReportLimit = 8 << 20;                  // bytes that a child may report
constexpr int kBlocksAtOnce = 64;                              // read of one pipe before the others get their turn
constexpr double kKillDeadline = 5.0;                          // seconds to wait for a killed child to end
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

/// Sets the soft limit, and the hard one `margin` above it, so that the task cannot raise its own limit.
void limit(int resource, double value, double margin = 0.0) {
  if (!(value + margin < 1e18)) return;
  rlimit current{};
  getrlimit(static_cast<__rlimit_resource_t>(resource), &current);
  const auto largest = static_cast<double>(current.rlim_max);
  current.rlim_cur = static_cast<rlim_t>(std::min(value, largest));
  current.rlim_max = static_cast<rlim_t>(std::min(value + margin, largest));
  setrlimit(static_cast<__rlimit_resource_t>(resource), &current);
}

/// Address space in use, from the first number of /proc/self/statm.
double address_space_bytes() {
  const std::string text = read_file("/proc/self/statm");
  const auto pages = parse_number(std::string_view(text).substr(0, text.find(' ')));
  return pages.value_or(0.0) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

constexpr std::string_view kOutOfMemory = "an allocation failed (std::bad_alloc)\n";

/// The new-handler of a child: runs before std::bad_alloc is thrown, even if nothing catches it.
void say_out_of_memory() {
  [[maybe_unused]] const ssize_t n = ::write(STDERR_FILENO, kOutOfMemory.data(), kOutOfMemory.size());
  std::set_new_handler(nullptr);
}

void set_limits(const WorkerLimits& limits) {
  std::set_new_handler(say_out_of_memory);
  limit(RLIMIT_CORE, 0);
  // CPU time is limited above the limit of wall time, in case the parent cannot act. SIGXCPU comes first, SIGKILL at
  // the margin.
  const double cores = std::max(1.0, static_cast<double>(::sysconf(_SC_NPROCESSORS_ONLN)));
  limit(RLIMIT_CPU, std::ceil(limits.seconds) * cores + 2.0, 2.0);
  // Each thread reserves address space for its stack and its heap arena without using it.
  const double reserve = 144.0 * 1024 * 1024 * (limits.threads > 1 ? limits.threads : 0);
  if (!SCANBENCH_UNDER_SANITIZER) limit(RLIMIT_AS, address_space_bytes() + limits.memory_bytes + reserve);
}

/// Cuts an exception's message, because a module may write one of any length.
std::string shortened(std::string text) {
  if (text.size() <= kMessageLimit) return text;
  const std::string rest = std::to_string(text.size() - kMessageLimit);
  text.resize(kMessageLimit);
  return text + " [" + rest + " more bytes]";
}

/// Runs the task and returns the bytes for the pipe: one character for the status, then the message.
std::string perform(const std::function<std::string()>& task) {
  try {
    return "o" + task();
  } catch (const std::bad_alloc&) {
    return "m";
  } catch (const InvalidResult& e) {
    return shortened(std::string("i") + e.what());
  } catch (const SystemError& e) {
    return shortened(std::string("s") + e.what());
  } catch (const std::filesystem::filesystem_error& e) {
    return shortened(std::string("s") + e.what());
  } catch (const ConfigError& e) {
    return shortened(std::string("c") + e.what());
  } catch (const ForeignFault& e) {
    const bool ended = e.kind() == ForeignFault::Kind::ended;
    const bool late = e.kind() == ForeignFault::Kind::timeout;
    const bool memory = e.kind() == ForeignFault::Kind::memory;
    return shortened(std::string(ended ? "e" : late ? "t" : memory ? "m" : "f") + e.what());
  } catch (const InternalError& e) {
    return shortened(std::string("finternal error: ") + e.what());
  } catch (const std::exception& e) {
    return shortened(std::string("f") + e.what());
  } catch (...) {
    return "fan exception that is no std::exception";
  }
}

/// Keeps only the child's output, its report as descriptor 3, and an empty standard input, so that processes started by
/// the task cannot hold the lock of the run's folder, the pipes of other children or the user's terminal. Returns 3.
int keep_only(int report, int output) {
  constexpr int kReport = STDERR_FILENO + 1;
  const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  // The pipes may have any descriptors, so both are moved above kReport first.
  const int from = ::fcntl(report, F_DUPFD_CLOEXEC, kReport + 1);
  const int to = ::fcntl(output, F_DUPFD_CLOEXEC, kReport + 1);
  if (from < 0 || to < 0 || nothing < 0) _exit(3);
  dup2(nothing, STDIN_FILENO);
  dup2(to, STDOUT_FILENO);
  dup2(to, STDERR_FILENO);
  dup3(from, kReport, O_CLOEXEC);
  ::close_range(kReport + 1, ~0U, 0);
  return kReport;
}

[[noreturn]] void live_as_child(const std::function<std::string()>& task, const WorkerLimits& limits, pid_t parent,
                                int report, int output) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(3);  // the parent ended before prctl() was called
  for (const int signal : kInterrupts)
    if (sigismember(&held, signal) == 1) std::signal(signal, SIG_DFL);
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit is then an error of write(), with a message
  sigprocmask(SIG_SETMASK, &old_mask, nullptr);
  adopt_orphans();  // what loses its parent here stays below this task as long as it runs, and ends with it
  report = keep_only(report, output);
  set_limits(limits);
  const std::string text = perform(task);
  std::fflush(nullptr);
  std::string_view rest = text;
  while (!rest.empty()) {
    const ssize_t n = ::write(report, rest.data(), rest.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) _exit(3);
    rest.remove_prefix(static_cast<std::size_t>(n));
  }
  _exit(0);
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
  std::size_t id;
  pid_t pid;
  int report;
  int output;
  int end;  ///< a descriptor of the process, which is readable when it has ended; -1 if the kernel has none
  double seconds;
  double start;
  bool killed_for_time = false;
  bool killed_for_report = false;
  bool killed_for_signal = false;
  bool report_open = true;
  bool output_open = true;
  std::string report_text = {};
  std::string output_text = {};

  void close() const {
    ::close(report);
    ::close(output);
    if (end >= 0) ::close(end);
  }

  void read_pipes() {
    if (report_open) report_open = drain(report, report_text);
    if (output_open) output_open = drain(output, output_text);
    if (output_text.size() > 2 * kTail) output_text.erase(0, output_text.size() - kTail);
    if (report_text.size() > kReportLimit && !killed_for_report) {
      killed_for_report = true;
      report_open = false;
      kill_child(pid);
    }
  }

  WorkerOutcome outcome(int wait_status, const rusage& usage) const {
    const auto seconds_of = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    WorkerOutcome result;
    result.wall_seconds = wall_seconds() - start;
    result.cpu_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
    result.peak_memory_bytes = 1024.0 * static_cast<double>(usage.ru_maxrss);
    if (killed_for_report) {
      result.status = CellStatus::failed;
      result.message = "reported more than " + std::to_string(kReportLimit) + " bytes";
      return result;
    }
    if (killed_for_signal) {
      result.status = CellStatus::crashed;
      result.message = "sent a signal to this program, which is for the user to do";
      return result;
    }
    const bool exited = WIFEXITED(wait_status) && WEXITSTATUS(wait_status) == 0 && !report_text.empty();
    if (exited && result.wall_seconds > seconds) {
      // It ended before the parent saw that its time was over. Which comes first must not change the result.
      result.status = CellStatus::timeout;
      result.message = over_time();
    } else if (exited) {
      result.message = report_text.substr(1);
      switch (report_text.front()) {
        case 'o':
          result.status = CellStatus::ok;
          return result;
        case 'i':
          result.status = CellStatus::invalid;
          break;
        case 'e':
          result.status = CellStatus::crashed;
          break;
        case 't':
          result.status = CellStatus::timeout;
          break;
        case 'm':
          result.status = CellStatus::out_of_memory;
          if (result.message.empty()) result.message = "an allocation failed under the memory limit";
          break;
        default:
          result.status = CellStatus::failed;
          result.bad_input = report_text.front() == 'c';
          result.system_error = report_text.front() == 's';
      }
    } else if (WIFSIGNALED(wait_status)) {
      describe_signal(WTERMSIG(wait_status), result);
    } else {
      result.status = CellStatus::crashed;
      result.message = "ended without a result, exit code " + std::to_string(WEXITSTATUS(wait_status));
    }
    if (!output_text.empty()) result.message += "\n" + output_tail(output_text);
    return result;
  }

  std::string over_time() const { return "took longer than the limit of " + number_text(seconds) + " s"; }

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

bool WorkerPool::interrupted() const {
  take_pending_signals();
  return interrupt_seen != 0;
}

bool WorkerPool::terminated() const {
  return run_is_terminated();
}

void WorkerPool::start(std::size_t id, const std::function<std::string()>& task, const WorkerLimits& limits) {
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
  if (pid == 0) live_as_child(task, limits, parent, report[1], output[1]);
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
  workers_.push_back({id, pid, report[0], output[0], static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)),
                      limits.seconds, wall_seconds()});
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
    pause = std::min(pause, w.report_open && !w.killed_for_time ? w.start + w.seconds - wall_seconds() : 1e-3);
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
    if (!w.killed_for_time && wall_seconds() > w.start + w.seconds) {
      w.killed_for_time = true;
      kill_child(w.pid);
    }
    if (!has_ended(w.pid)) {
      ++i;
      continue;
    }
    ::kill(-w.pid, SIGKILL);  // processes that the task may have started
    w.read_pipes();           // the rest, which is less than one read takes
    int status = 0;
    rusage usage{};
    ::wait4(w.pid, &status, 0, &usage);
    end_descendants(w.pid);
    w.close();
    finished.push_back({w.id, w.outcome(status, usage)});
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
