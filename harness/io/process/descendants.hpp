// Processes below this one: orphans of tasks, and senders of signals.
#pragma once

#include <sys/types.h>

#include <vector>

namespace scanbench::io {

/// Processes that have lost their parent become children of this process instead of the system's first one.
void adopt_orphans();

/// The children of this process, which must have one thread.
std::vector<pid_t> children();

/// Kills and reaps all children but those in `spared`, and the children that this gives to this process, for at most a
/// second: nothing that a task started outlives it, not even in a session of its own.
void kill_orphans(const std::vector<pid_t>& spared);

/// While one exists, this process, which must have one thread, adopts orphans. At its end it kills those processes
/// below this one that were not children of it before: nothing that was started meanwhile stays.
class NothingStays {
 public:
  NothingStays();
  ~NothingStays();
  NothingStays(const NothingStays&) = delete;
  NothingStays& operator=(const NothingStays&) = delete;

 private:
  std::vector<pid_t> before_;
  int adopted_before_ = 0;
};

/// The child of this process that `pid` descends from, or is; 0 if it is not a descendant or does not exist any more.
pid_t branch_of(pid_t pid);

/// How many processes the kernel has killed since the machine started because memory ran out; 0 if it does not say.
double out_of_memory_kills();

}  // namespace scanbench::io
