// Limits of a process that runs code of others.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace scanbench::study {

inline constexpr int kMostProcesses = 64;                   ///< that a foreign module may have, threads included
inline constexpr double kLargestFile = 1024.0 * (1 << 20);  ///< that it may write, bytes

/// Limits the calling process and all that it starts: the number of processes, the size of a file, no core files, no
/// rights of another user through files that are set to run as that user. Where the system allows control groups, the
/// memory and the processes of all together are limited too; the kernel does not apply the limit of a user's processes
/// to root.
void confine();

/// Takes the network from the calling process, which has one thread, and from all that it starts: the sandbox of a
/// library. False if the system does not allow it.
bool leave_network();

/// Removes the control group that confine() has made for a process that has ended.
void remove_confinement(pid_t pid);

/// The limits that are active for foreign modules on this machine, as the manifest names them; of a sandbox what it
/// does for programs and for libraries, if there are any in it.
std::vector<std::string> active_confinement(bool programs_in_sandbox, bool libraries_in_sandbox);

/// True where all processes of a cell share one limit of memory, and where they share one of processes.
struct SharedLimits {
  bool memory = false;
  bool processes = false;
};
SharedLimits shared_limits();

/// Tries whether leave_network() can be done here, in a child process.
bool can_leave_network();

}  // namespace scanbench::study
