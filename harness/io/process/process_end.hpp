// How a process ended, and what it used.
#pragma once

#include <sys/resource.h>

#include <string>

namespace scanbench::io {

struct ProcessUsage {
  double cpu_seconds = 0.0;  ///< of the process and of the children that it waited for
  double peak_memory_bytes = 0.0;
};

ProcessUsage usage_of(const rusage& usage);

/// Of this process.
ProcessUsage usage_so_far();

struct ProcessEnd {
  int signal = 0;  ///< that ended it; 0 if it exited
  int exit_code = 0;
  ProcessUsage usage;

  bool is_success() const { return signal == 0 && exit_code == 0; }
};

/// From the status and the usage that wait4() gives.
ProcessEnd process_end(int wait_status, const rusage& usage);

/// "by signal 11 (Segmentation fault)" or "with exit code 3".
std::string to_text(const ProcessEnd& end);

}  // namespace scanbench::io
