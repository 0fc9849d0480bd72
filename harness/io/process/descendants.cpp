// Finds and ends processes below this one, from the files of /proc.
#include "harness/io/process/descendants.hpp"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "core/number_text.hpp"

namespace scanbench::io {
namespace {

constexpr int kRounds = 1000;  // of a millisecond

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The parent of a process, from "pid (name) state parent ..."; 0 if there is no such process.
pid_t parent_of(pid_t pid) {
  const std::string text = text_of("/proc/" + std::to_string(pid) + "/stat");
  const std::size_t name_end = text.rfind(')');  // the name itself may have parentheses
  if (name_end == std::string::npos || name_end + 4 >= text.size()) return 0;
  pid_t parent = 0;
  std::from_chars(text.data() + name_end + 4, text.data() + text.size(), parent);
  return parent;
}

}  // namespace

void adopt_orphans() {
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
}

std::vector<pid_t> children() {
  const std::string pid = std::to_string(::getpid());
  std::ifstream file("/proc/" + pid + "/task/" + pid + "/children");
  return {std::istream_iterator<pid_t>(file), {}};
}

void kill_orphans(const std::vector<pid_t>& spared) {
  // Without any other child, which is the rule, one call shows it.
  for (int round = 0; round < kRounds; ++round) {
    bool any = false;
    for (const pid_t pid : children()) {
      if (std::ranges::find(spared, pid) != spared.end()) continue;
      any = true;
      ::kill(-pid, SIGKILL);
      ::kill(pid, SIGKILL);
      ::waitpid(pid, nullptr, WNOHANG);
    }
    if (!any) return;
    const timespec pause{0, 1000000};
    ::nanosleep(&pause, nullptr);
  }
}

NothingStays::NothingStays() : before_(children()) {
  ::prctl(PR_GET_CHILD_SUBREAPER, &adopted_before_);
  adopt_orphans();
}

NothingStays::~NothingStays() {
  kill_orphans(before_);
  ::prctl(PR_SET_CHILD_SUBREAPER, adopted_before_);
}

pid_t branch_of(pid_t pid) {
  constexpr int kDeepest = 1000;
  for (int depth = 0; pid > 1 && depth < kDeepest; ++depth) {
    const pid_t parent = parent_of(pid);
    if (parent == ::getpid()) return pid;
    pid = parent;
  }
  return 0;
}

double out_of_memory_kills() {
  const std::string text = text_of("/proc/vmstat");
  constexpr std::string_view kName = "\noom_kill ";
  const std::size_t at = text.find(kName);
  if (at == std::string::npos) return 0.0;
  const std::string_view rest = std::string_view(text).substr(at + kName.size());
  return parse_number(rest.substr(0, rest.find('\n'))).value_or(0.0);
}

}  // namespace scanbench::io
