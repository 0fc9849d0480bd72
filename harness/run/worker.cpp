// fork, setrlimit, pipes, wait4.
#include "harness/run/worker.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <thread>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "harness/files/atomic_file.hpp"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SCANBENCH_UNDER_SANITIZER 1
#else
#define SCANBENCH_UNDER_SANITIZER 0
#endif

namespace scanbench::harness {
namespace {

constexpr std::size_t kTail = 4096;  // bytes kept of what a child prints

volatile std::sig_atomic_t interrupt_seen = 0;
struct sigaction old_int, old_term;
sigset_t old_mask;

void on_interrupt(int) {
  interrupt_seen = 1;
}

double wall_seconds() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void limit(int resource, double value) {
  rlimit current{};
  getrlimit(static_cast<__rlimit_resource_t>(resource), &current);
  current.rlim_cur = static_cast<rlim_t>(std::min(value, static_cast<double>(current.rlim_max)));
  if (value < 1e18) setrlimit(static_cast<__rlimit_resource_t>(resource), &current);
}

/// Address space in use, from the first number of /proc/self/statm.
double address_space_bytes() {
  const std::string text = read_file("/proc/self/statm");
  const auto pages = parse_number(std::string_view(text).substr(0, text.find(' ')));
  return pages.value_or(0.0) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

constexpr std::string_view kOutOfMemory = "an allocation failed (std::bad_alloc)\n";

/// The new-handler of a child: the last that is certain to run before std::bad_alloc, whatever becomes of it.
void say_out_of_memory() {
  [[maybe_unused]] const ssize_t n = ::write(STDERR_FILENO, kOutOfMemory.data(), kOutOfMemory.size());
  std::set_new_handler(nullptr);
}

void set_limits(const WorkerLimits& limits) {
  std::set_new_handler(say_out_of_memory);
  limit(RLIMIT_CORE, 0);
  // Behind the wall-clock limit, for the case that the parent cannot act.
  const double cores = std::max(1U, std::thread::hardware_concurrency());
  limit(RLIMIT_CPU, std::ceil(limits.seconds) * cores + 2.0);
  // Each thread reserves address space for its stack and its heap arena without using it.
  const double reserve = 144.0 * 1024 * 1024 * (limits.threads > 1 ? limits.threads : 0);
  if (!SCANBENCH_UNDER_SANITIZER) limit(RLIMIT_AS, address_space_bytes() + limits.memory_bytes + reserve);
}

/// What goes through the pipe: one character for the status, then the message.
std::string perform(const std::function<std::string()>& task) {
  try {
    return "o" + task();
  } catch (const std::bad_alloc&) {
    return "m";
  } catch (const InvalidResult& e) {
    return std::string("i") + e.what();
  } catch (const ConfigError& e) {
    return std::string("c") + e.what();
  } catch (const InternalError& e) {
    return std::string("finternal error: ") + e.what();
  } catch (const std::exception& e) {
    return std::string("f") + e.what();
  } catch (...) {
    return "fan exception that is no std::exception";
  }
}

[[noreturn]] void live_as_child(const std::function<std::string()>& task, const WorkerLimits& limits, int report,
                                int output) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit is then an error of write(), with a message
  sigprocmask(SIG_SETMASK, &old_mask, nullptr);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
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

/// Reads what is there. False at the end.
bool drain(int fd, std::string& text) {
  std::array<char, 1 << 14> block{};
  while (true) {
    const ssize_t n = ::read(fd, block.data(), block.size());
    if (n > 0) {
      text.append(block.data(), static_cast<std::size_t>(n));
    } else if (n == 0) {
      return false;
    } else if (errno != EINTR) {
      return errno == EAGAIN;
    }
  }
}

}  // namespace

struct WorkerPool::Worker {
  std::size_t id;
  pid_t pid;
  int report;
  int output;
  double seconds;
  double start;
  bool killed_for_time = false;
  bool report_open = true;
  bool output_open = true;
  std::string report_text = {};
  std::string output_text = {};

  void read_pipes() {
    if (report_open) report_open = drain(report, report_text);
    if (output_open) output_open = drain(output, output_text);
    if (output_text.size() > 2 * kTail) output_text.erase(0, output_text.size() - kTail);
  }

  WorkerOutcome outcome(int wait_status, const rusage& usage) const {
    const auto seconds_of = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    WorkerOutcome result;
    result.wall_seconds = wall_seconds() - start;
    result.cpu_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
    result.peak_memory_bytes = 1024.0 * static_cast<double>(usage.ru_maxrss);
    const bool exited = WIFEXITED(wait_status) && WEXITSTATUS(wait_status) == 0 && !report_text.empty();
    if (exited) {
      result.message = report_text.substr(1);
      switch (report_text.front()) {
        case 'o':
          result.status = CellStatus::ok;
          return result;
        case 'i':
          result.status = CellStatus::invalid;
          break;
        case 'm':
          result.status = CellStatus::out_of_memory;
          result.message = "an allocation failed under the memory limit";
          break;
        default:
          result.status = CellStatus::failed;
          result.bad_input = report_text.front() == 'c';
      }
    } else if (WIFSIGNALED(wait_status)) {
      describe_signal(WTERMSIG(wait_status), result);
    } else {
      result.status = CellStatus::crashed;
      result.message = "ended without a result, exit code " + std::to_string(WEXITSTATUS(wait_status));
    }
    if (!output_text.empty())
      result.message += "\n" + output_text.substr(output_text.size() - std::min(output_text.size(), kTail));
    return result;
  }

  void describe_signal(int signal, WorkerOutcome& result) const {
    if (killed_for_time) {
      result.status = CellStatus::timeout;
      result.message = "killed after the limit of " + number_text(seconds) + " s";
    } else if (signal == SIGXCPU) {
      result.status = CellStatus::timeout;
      result.message = "used up the limit of CPU time";
    } else if (signal == SIGKILL) {
      result.status = CellStatus::out_of_memory;
      result.message = "killed by the system, most likely for want of memory";
    } else {
      // A bad_alloc that met a noexcept ends by abort(): say_out_of_memory() has left its word.
      const bool memory = output_text.find(kOutOfMemory) != std::string::npos;
      result.status = memory ? CellStatus::out_of_memory : CellStatus::crashed;
      result.message = "ended by signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
    }
  }
};

WorkerPool::WorkerPool() {
  interrupt_seen = 0;
  struct sigaction action {};
  action.sa_handler = on_interrupt;
  sigaction(SIGINT, &action, &old_int);
  sigaction(SIGTERM, &action, &old_term);
  sigset_t held;
  sigemptyset(&held);
  sigaddset(&held, SIGINT);
  sigaddset(&held, SIGTERM);
  sigprocmask(SIG_BLOCK, &held, &old_mask);
}

WorkerPool::~WorkerPool() {
  kill_all();
  sigprocmask(SIG_SETMASK, &old_mask, nullptr);
  sigaction(SIGINT, &old_int, nullptr);
  sigaction(SIGTERM, &old_term, nullptr);
}

std::size_t WorkerPool::running() const {
  return workers_.size();
}

bool WorkerPool::interrupted() const {
  // While pipes keep having something to read, ppoll() returns before it delivers a signal: ask for it.
  sigset_t pending;
  sigpending(&pending);
  return interrupt_seen != 0 || sigismember(&pending, SIGINT) == 1 || sigismember(&pending, SIGTERM) == 1;
}

void WorkerPool::start(std::size_t id, const std::function<std::string()>& task, const WorkerLimits& limits) {
  int report[2];
  int output[2];
  if (::pipe2(report, O_CLOEXEC) != 0) throw ConfigError(std::string("cannot start a worker: ") + std::strerror(errno));
  if (::pipe2(output, O_CLOEXEC) != 0) {
    ::close(report[0]);
    ::close(report[1]);
    throw ConfigError(std::string("cannot start a worker: ") + std::strerror(errno));
  }
  std::fflush(nullptr);  // or the child would print our buffers once more
  const pid_t pid = ::fork();
  if (pid == 0) live_as_child(task, limits, report[1], output[1]);
  ::close(report[1]);
  ::close(output[1]);
  if (pid < 0) {
    ::close(report[0]);
    ::close(output[0]);
    throw ConfigError(std::string("cannot start a worker: ") + std::strerror(errno));
  }
  setpgid(pid, pid);  // in both processes: whoever comes first
  fcntl(report[0], F_SETFL, O_NONBLOCK);
  fcntl(output[0], F_SETFL, O_NONBLOCK);
  workers_.push_back({id, pid, report[0], output[0], limits.seconds, wall_seconds()});
}

std::vector<WorkerPool::Finished> WorkerPool::wait() {
  std::vector<Finished> finished;
  while (finished.empty() && !workers_.empty() && !interrupted()) {
    std::vector<pollfd> fds;
    double pause = 0.02;  // nothing wakes us when a child ends while a process that it started holds its pipes
    for (const auto& w : workers_) {
      if (w.report_open) fds.push_back({w.report, POLLIN, 0});
      if (w.output_open) fds.push_back({w.output, POLLIN, 0});
      // A closed report means that the end is near; then there is nothing left to poll.
      pause = std::min(pause, w.report_open && !w.killed_for_time ? w.start + w.seconds - wall_seconds() : 1e-3);
    }
    pause = std::max(pause, 0.0);
    const timespec timeout{static_cast<time_t>(pause), static_cast<long>(1e9 * (pause - std::floor(pause)))};
    ::ppoll(fds.data(), fds.size(), &timeout, &old_mask);  // signals arrive here and nowhere else

    for (std::size_t i = 0; i < workers_.size();) {
      Worker& w = workers_[i];
      w.read_pipes();
      if (!w.killed_for_time && wall_seconds() > w.start + w.seconds) {
        w.killed_for_time = true;
        ::kill(-w.pid, SIGKILL);
      }
      int status = 0;
      rusage usage{};
      if (::wait4(w.pid, &status, WNOHANG, &usage) != w.pid) {
        ++i;
        continue;
      }
      w.read_pipes();
      ::kill(-w.pid, SIGKILL);  // what the task may have started itself
      ::close(w.report);
      ::close(w.output);
      finished.push_back({w.id, w.outcome(status, usage)});
      workers_.erase(workers_.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
  return finished;
}

void WorkerPool::kill_all() {
  for (const auto& w : workers_) ::kill(-w.pid, SIGKILL);
  for (const auto& w : workers_) {
    ::waitpid(w.pid, nullptr, 0);
    ::close(w.report);
    ::close(w.output);
  }
  workers_.clear();
}

}  // namespace scanbench::harness
