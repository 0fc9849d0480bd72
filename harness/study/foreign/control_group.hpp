// Control groups of Linux: limits of a process and all that it starts, taken together.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace scanbench::study {

/// The folders in which this process may make control groups; an empty path where it may not. In version 2 both are one
/// folder.
struct GroupFolders {
  std::filesystem::path memory;
  std::filesystem::path processes;
};

/// Looks below `mounted`, where the control groups of this machine are, from the groups that `own` names, which is the
/// text of /proc/self/cgroup. Of version 2 it is the nearest group from which the controllers are handed down: the own
/// one, or one above it if no group on the way has limits of its own, which would be left. Of version 1 it is the own
/// group of each controller.
GroupFolders group_folders(const std::filesystem::path& mounted, const std::string& own);

/// Those of this process, in /sys/fs/cgroup.
const GroupFolders& group_folders();

/// Puts this process into new groups, named after its process id, that allow this many bytes of memory (not limited if
/// infinite) and this many processes, threads included. What the system refuses is left out.
void enter_groups(const GroupFolders& folders, double memory_bytes, int processes);

/// Removes the groups of a process that has ended.
void remove_groups(const GroupFolders& folders, pid_t pid);

/// The files that hold the limits, as the manifest names them: "cgroup memory.max", "cgroup pids.max".
std::vector<std::string> group_limits(const GroupFolders& folders);

}  // namespace scanbench::study
