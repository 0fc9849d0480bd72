// The life of a child process, from fork() to _exit().
#include "harness/run/worker_child.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <new>
#include <utility>

#include <cerrno>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "core/number_text.hpp"
#include "harness/files/atomic_file.hpp"
#include "harness/run/descendants.hpp"
#include "harness/run/worker_report.hpp"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SCANBENCH_UNDER_SANITIZER 1
#else
#define SCANBENCH_UNDER_SANITIZER 0
#endif

namespace scanbench::harness {
namespace {

/// Sets the soft limit, and for the last task the hard one `margin` above it, so that the task cannot raise its own
/// limit.
void limit(int resource, double value, double margin, bool is_last) {
  if (!(value + margin < 1e18)) return;
  rlimit current{};
  getrlimit(static_cast<__rlimit_resource_t>(resource), &current);
  const auto largest = static_cast<double>(current.rlim_max);
  current.rlim_cur = static_cast<rlim_t>(std::min(value, largest));
  if (is_last) current.rlim_max = static_cast<rlim_t>(std::min(value + margin, largest));
  setrlimit(static_cast<__rlimit_resource_t>(resource), &current);
}

/// Address space in use, from the first number of /proc/self/statm.
double address_space_bytes() {
  const std::string text = read_file("/proc/self/statm");
  const auto pages = parse_number(std::string_view(text).substr(0, text.find(' ')));
  return pages.value_or(0.0) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// The new-handler of a child: runs before std::bad_alloc is thrown, even if nothing catches it.
void say_out_of_memory() {
  [[maybe_unused]] const ssize_t n = ::write(STDERR_FILENO, kOutOfMemory.data(), kOutOfMemory.size());
  std::set_new_handler(nullptr);
}

struct Usage {
  double cpu_seconds = 0.0;
  double peak_memory_bytes = 0.0;
};

Usage usage_so_far() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds_of = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return {seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime), 1024.0 * static_cast<double>(usage.ru_maxrss)};
}

void set_limits(const WorkerLimits& limits, bool is_last) {
  std::set_new_handler(say_out_of_memory);
  limit(RLIMIT_CORE, 0, 0.0, is_last);
  // CPU time is limited above the limit of wall time, in case the parent cannot act. SIGXCPU comes first, SIGKILL at
  // the margin.
  const double cores = std::max(1.0, static_cast<double>(::sysconf(_SC_NPROCESSORS_ONLN)));
  limit(RLIMIT_CPU, std::ceil(usage_so_far().cpu_seconds) + std::ceil(limits.seconds) * cores + 2.0, 2.0, is_last);
  // Each thread reserves address space for its stack and its heap arena without using it.
  const double reserve = 144.0 * 1024 * 1024 * (limits.threads > 1 ? limits.threads : 0);
  if (!SCANBENCH_UNDER_SANITIZER) limit(RLIMIT_AS, address_space_bytes() + limits.memory_bytes + reserve, 0.0, is_last);
}

/// From here on, the peak of this process's memory is that of the next task.
void forget_peak_memory() {
  const int file = ::open("/proc/self/clear_refs", O_WRONLY | O_CLOEXEC);
  if (file < 0) return;
  [[maybe_unused]] const ssize_t n = ::write(file, "5", 1);
  ::close(file);
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

void send(int report, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(report, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) _exit(3);
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

}  // namespace

void live_as_child(std::span<const WorkerTask> tasks, const ChildSetting& setting) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != setting.parent) _exit(3);  // the parent ended before prctl() was called
  for (int signal = 1; signal < NSIG; ++signal)
    if (sigismember(&setting.defaulted, signal) == 1) std::signal(signal, SIG_DFL);
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit is then an error of write(), with a message
  sigprocmask(SIG_SETMASK, &setting.mask, nullptr);
  adopt_orphans();  // what loses its parent here stays below this task as long as it runs, and ends with it
  const int pipe = keep_only(setting.report, setting.output);
  double cpu_seconds = 0.0;
  for (const WorkerTask& task : tasks) {
    if (&task != tasks.data()) forget_peak_memory();
    set_limits(task.limits, &task == &tasks.back());
    WorkerReport report = perform(task.work);
    const Usage usage = usage_so_far();
    report.outcome.cpu_seconds = usage.cpu_seconds - std::exchange(cpu_seconds, usage.cpu_seconds);
    report.outcome.peak_memory_bytes = usage.peak_memory_bytes;
    std::fflush(nullptr);
    send(pipe, report_bytes(report));
    if (report.outcome.status != CellStatus::ok) break;
  }
  _exit(0);
}

}  // namespace scanbench::harness
