// Interprets what the system says of a process.
#include "harness/io/process/process_end.hpp"

#include <sys/wait.h>

#include <cstring>

namespace scanbench::io {

ProcessUsage usage_of(const rusage& usage) {
  const auto seconds_of = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return {seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime), 1024.0 * static_cast<double>(usage.ru_maxrss)};
}

ProcessUsage usage_so_far() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage_of(usage);
}

ProcessEnd process_end(int wait_status, const rusage& usage) {
  ProcessEnd end{.usage = usage_of(usage)};
  if (WIFSIGNALED(wait_status))
    end.signal = WTERMSIG(wait_status);
  else
    end.exit_code = WEXITSTATUS(wait_status);
  return end;
}

std::string to_text(const ProcessEnd& end) {
  if (end.signal == 0) return "with exit code " + std::to_string(end.exit_code);
  return "by signal " + std::to_string(end.signal) + " (" + ::strsignal(end.signal) + ")";
}

}  // namespace scanbench::io
