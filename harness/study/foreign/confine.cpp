// Sets resource limits.
#include "harness/study/foreign/confine.hpp"

#include <dirent.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include "harness/io/process/child.hpp"
#include "harness/study/foreign/control_group.hpp"

namespace scanbench::study {
namespace {

constexpr double kMemoryOfDescription = 4096.0 * (1 << 20);  // bytes; no cell sets a limit there

/// Lowers a limit, never raises it.
void lower(__rlimit_resource_t resource, double value) {
  rlimit current{};
  ::getrlimit(resource, &current);
  current.rlim_max = std::min(current.rlim_max, static_cast<rlim_t>(value));
  current.rlim_cur = std::min(current.rlim_cur, current.rlim_max);
  ::setrlimit(resource, &current);
}

/// Processes and threads of this user, which the kernel counts together, from the folders of /proc.
int tasks_of_user() {
  DIR* proc = ::opendir("/proc");
  if (proc == nullptr) return 0;
  int tasks = 0;
  while (const dirent* entry = ::readdir(proc)) {
    if (entry->d_name[0] < '1' || entry->d_name[0] > '9') continue;
    struct stat info {};
    const std::string folder = "/proc/" + std::string(entry->d_name) + "/task";
    if (::stat(folder.c_str(), &info) == 0 && info.st_uid == ::getuid()) tasks += static_cast<int>(info.st_nlink) - 2;
  }
  ::closedir(proc);
  return tasks;
}

bool write_text(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  file << text << std::flush;
  return file.good();
}

/// Bytes that the processes of a cell may use together: what one of them could map alone.
double memory_of_all() {
  rlimit current{};
  ::getrlimit(RLIMIT_AS, &current);
  return current.rlim_cur == RLIM_INFINITY ? kMemoryOfDescription : static_cast<double>(current.rlim_cur);
}

}  // namespace

bool leave_network() {
  if (::unshare(CLONE_NEWNET) == 0) return true;  // allowed to root
  const std::string user = std::to_string(::getuid()), group = std::to_string(::getgid());
  if (::unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) return false;
  // The same user in the new namespace, or a program that this process starts could not have its own.
  write_text("/proc/self/setgroups", "deny");
  write_text("/proc/self/gid_map", group + " " + group + " 1");
  return write_text("/proc/self/uid_map", user + " " + user + " 1");
}

bool can_leave_network() {
  try {
    return io::start_child({}, [] { return leave_network() ? 0 : 1; }).reap().is_success();
  } catch (const std::system_error&) {
    return false;
  }
}

SharedLimits shared_limits() {
  const GroupFolders& folders = group_folders();
  return {!folders.memory.empty(), !folders.processes.empty()};
}

void remove_confinement(pid_t pid) {
  remove_groups(group_folders(), pid);
}

std::vector<std::string> active_confinement(bool programs_in_sandbox, bool libraries_in_sandbox) {
  std::vector<std::string> names{"RLIMIT_CORE", "RLIMIT_FSIZE", "PR_SET_NO_NEW_PRIVS"};
  if (::getuid() != 0) names.emplace_back("RLIMIT_NPROC");
  for (std::string& name : group_limits(group_folders())) names.push_back(std::move(name));
  if (programs_in_sandbox) names.emplace_back("bubblewrap (programs)");
  if (libraries_in_sandbox && can_leave_network()) names.emplace_back("network namespace (libraries)");
  return names;
}

void confine() {
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  lower(RLIMIT_CORE, 0);
  lower(RLIMIT_FSIZE, kLargestFile);
  lower(RLIMIT_NPROC, tasks_of_user() + kMostProcesses);
  enter_groups(group_folders(), memory_of_all(), kMostProcesses);
}

}  // namespace scanbench::study
