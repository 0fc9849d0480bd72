// Finds, makes and removes control groups, through their files.
#include "harness/study/foreign/control_group.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <sstream>

namespace scanbench::study {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMemory = "memory.max";
constexpr const char* kMemoryOfVersion1 = "memory.limit_in_bytes";
constexpr const char* kProcesses = "pids.max";
constexpr int kRounds = 20;  // of a millisecond, for the processes of a group to end

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

bool write_text(const fs::path& file, const std::string& text) {
  if (!fs::exists(file)) return false;  // or a file would be made where no control groups are
  std::ofstream out(file);
  out << text << std::flush;
  return out.good();
}

bool has_word(const std::string& text, const std::string& word) {
  std::istringstream words(text);
  return std::find(std::istream_iterator<std::string>(words), {}, word) != std::istream_iterator<std::string>();
}

/// The group of a controller, from lines "8:pids:/a/b"; that of version 2 has no name.
std::optional<std::string> own_group(const std::string& own, const std::string& controller) {
  std::istringstream lines(own);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    std::string names = line.substr(first + 1, second - first - 1);
    std::ranges::replace(names, ',', ' ');
    if (controller.empty() ? names.empty() : has_word(names, controller)) return line.substr(second + 1);
  }
  return std::nullopt;
}

bool may_make_groups(const fs::path& folder) {
  return ::access(folder.c_str(), W_OK | X_OK) == 0 && ::access((folder / "cgroup.procs").c_str(), W_OK) == 0;
}

bool hands_down(const fs::path& group) {
  const std::string controllers = text_of(group / "cgroup.subtree_control");
  return has_word(controllers, "memory") && has_word(controllers, "pids");
}

/// True if a process that leaves the group leaves a limit.
bool limits_itself(const fs::path& group) {
  const auto limits = [&](const char* file) {
    const std::string text = text_of(group / file);
    return !text.empty() && !text.starts_with("max");
  };
  return limits(kMemory) || limits("cpu.max");
}

/// Of version 2; empty if there is none.
fs::path folder_of_version_2(const fs::path& mounted, const std::string& own) {
  const auto path = own_group(own, "");
  if (!path) return {};
  const fs::path root = fs::exists(mounted / "cgroup.controllers") ? mounted : mounted / "unified";
  for (fs::path group = fs::path(*path).relative_path();; group = group.parent_path()) {
    const fs::path folder = group.empty() ? root : root / group;
    if (hands_down(folder)) return may_make_groups(folder) ? folder : fs::path();
    if (group.empty() || limits_itself(folder)) return {};
  }
}

fs::path folder_of_version_1(const fs::path& mounted, const std::string& own, const std::string& controller) {
  const auto path = own_group(own, controller);
  if (!path) return {};
  fs::path folder = mounted / controller / fs::path(*path).relative_path();
  if (!fs::exists(folder)) folder = mounted / controller;  // in a container: its own group
  return may_make_groups(folder) ? folder : fs::path();
}

fs::path group_of(const fs::path& folder, pid_t pid) {
  return folder / ("scanbench-" + std::to_string(pid));
}

/// Makes the group of this process, if there is none yet; an empty path if the system refuses.
fs::path made_group(const fs::path& folder) {
  if (folder.empty()) return {};
  fs::path group = group_of(folder, ::getpid());
  if (::mkdir(group.c_str(), 0755) != 0 && errno != EEXIST) return {};
  return group;
}

}  // namespace

GroupFolders group_folders(const fs::path& mounted, const std::string& own) {
  if (const fs::path folder = folder_of_version_2(mounted, own); !folder.empty()) return {folder, folder};
  return {folder_of_version_1(mounted, own, "memory"), folder_of_version_1(mounted, own, "pids")};
}

const GroupFolders& group_folders() {
  static const GroupFolders folders = group_folders("/sys/fs/cgroup", text_of("/proc/self/cgroup"));
  return folders;
}

void enter_groups(const GroupFolders& folders, double memory_bytes, int processes) {
  const std::string pid = std::to_string(::getpid());
  if (const fs::path group = made_group(folders.memory); !group.empty() && std::isfinite(memory_bytes)) {
    const std::string bytes = std::to_string(static_cast<long long>(memory_bytes));
    if (!write_text(group / kMemory, bytes)) write_text(group / kMemoryOfVersion1, bytes);
    write_text(group / "memory.swap.max", "0");
    write_text(group / "memory.oom.group", "1");  // the cell ends as a whole
    write_text(group / "cgroup.procs", pid);
  }
  if (const fs::path group = made_group(folders.processes); !group.empty()) {
    write_text(group / kProcesses, std::to_string(processes));
    write_text(group / "cgroup.procs", pid);
  }
}

void remove_groups(const GroupFolders& folders, pid_t pid) {
  static std::set<fs::path> left;  // of earlier calls, whose processes had not all ended
  const auto remove = [](const fs::path& group) { return ::rmdir(group.c_str()) == 0 || errno != EBUSY; };
  std::erase_if(left, remove);
  for (const fs::path& folder : {folders.memory, folders.processes}) {
    if (folder.empty()) continue;
    const fs::path group = group_of(folder, pid);
    bool removed = remove(group);
    for (int round = 0; round < kRounds && !removed; ++round) {
      ::usleep(1000);  // a killed process ends soon
      removed = remove(group);
    }
    if (!removed) left.insert(group);
  }
}

std::vector<std::string> group_limits(const GroupFolders& folders) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& file) { names.push_back("cgroup " + file); };
  if (!folders.memory.empty()) add(folders.memory == folders.processes ? kMemory : kMemoryOfVersion1);
  if (!folders.processes.empty()) add(kProcesses);
  return names;
}

}  // namespace scanbench::study
