// Limits of a process that runs code of others.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace scanbench::harness {

inline constexpr int kMostProcesses = 64;                   ///< that a foreign module may have, threads included
inline constexpr double kLargestFile = 1024.0 * (1 << 20);  ///< that it may write, bytes

/// Limits the calling process and all that it starts: the number of processes, the size of a file, no core files. The
/// kernel does not apply the limit of processes to root, who gets a control group of it where the system allows that.
void confine();

/// Removes the control group that confine() has made for a process that has ended.
void remove_confinement(pid_t pid);

/// The limits that are active for foreign modules on this machine, as the manifest names them.
std::vector<std::string> active_confinement(bool sandbox);

}  // namespace scanbench::harness
