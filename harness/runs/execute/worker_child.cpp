// Limits, runs and reports the tasks of a child process.
#include "harness/runs/execute/worker_child.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <new>
#include <utility>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "core/number_text.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/descriptor.hpp"
#include "harness/io/process/descendants.hpp"
#include "harness/io/process/process_end.hpp"
#include "harness/runs/execute/worker_report.hpp"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SCANBENCH_UNDER_SANITIZER 1
#else
#define SCANBENCH_UNDER_SANITIZER 0
#endif

namespace scanbench::runs {
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
  const std::string text = io::read_file("/proc/self/statm");
  const auto pages = parse_number(std::string_view(text).substr(0, text.find(' ')));
  return pages.value_or(0.0) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// The new-handler of a child: runs before std::bad_alloc is thrown, even if nothing catches it.
void say_out_of_memory() {
  [[maybe_unused]] const ssize_t n = ::write(STDERR_FILENO, kOutOfMemory.data(), kOutOfMemory.size());
  std::set_new_handler(nullptr);
}

void set_limits(const WorkerLimits& limits, bool is_last) {
  std::set_new_handler(say_out_of_memory);
  limit(RLIMIT_CORE, 0, 0.0, is_last);
  // CPU time is limited above the limit of wall time, in case the parent cannot act. SIGXCPU comes first, SIGKILL at
  // the margin.
  const double cores = std::max(1.0, static_cast<double>(::sysconf(_SC_NPROCESSORS_ONLN)));
  limit(RLIMIT_CPU, std::ceil(io::usage_so_far().cpu_seconds) + std::ceil(limits.seconds) * cores + 2.0, 2.0, is_last);
  // Each thread reserves address space for its stack and its heap arena without using it.
  const double reserve = 144.0 * 1024 * 1024 * (limits.threads > 1 ? limits.threads : 0);
  if (!SCANBENCH_UNDER_SANITIZER) limit(RLIMIT_AS, address_space_bytes() + limits.memory_bytes + reserve, 0.0, is_last);
}

/// From here on, the peak of this process's memory is that of the next task.
void forget_peak_memory() {
  const io::FileDescriptor file(::open("/proc/self/clear_refs", O_WRONLY | O_CLOEXEC));
  io::write_all(file.number(), std::as_bytes(std::span("5", 1)));
}

}  // namespace

void perform_in_child(std::span<const WorkerTask> tasks, int report) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit is then an error of write(), with a message
  io::adopt_orphans();  // what loses its parent here stays below this task as long as it runs, and ends with it
  double cpu_seconds = 0.0;
  for (const WorkerTask& task : tasks) {
    if (&task != tasks.data()) forget_peak_memory();
    set_limits(task.limits, &task == &tasks.back());
    WorkerReport done = perform(task.work);
    const io::ProcessUsage usage = io::usage_so_far();
    done.outcome.cpu_seconds = usage.cpu_seconds - std::exchange(cpu_seconds, usage.cpu_seconds);
    done.outcome.peak_memory_bytes = usage.peak_memory_bytes;
    std::fflush(nullptr);
    const std::string bytes = report_bytes(done);
    if (!io::write_all(report, std::as_bytes(std::span(bytes)))) _exit(3);
    if (done.outcome.status != CellStatus::ok) break;
  }
}

}  // namespace scanbench::runs
