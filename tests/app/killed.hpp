// Runs the program under ptrace() and kills it, with all that it has started, where it is about to change the disk for
// the n-th time.
#pragma once

#include <fcntl.h>
#include <linux/fs.h>
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "tests/app/program.hpp"

namespace scanbench::app_test {

/// How a file system answers that cannot exchange two names.
enum class Exchange { in_one_step, refused };

struct Killed {
  std::size_t changes = 0;  ///< system calls that change names on the disk, before the end
  bool killed = false;      ///< false: the program ended before
  int code = -1;            ///< of a program that ended
};

/// Changes of names: each file and folder of a run appears and vanishes by one.
inline bool changes_names(unsigned long long call) {
  constexpr std::array kCalls{SYS_rename, SYS_renameat, SYS_renameat2, SYS_link,    SYS_linkat,
                              SYS_unlink, SYS_unlinkat, SYS_mkdir,     SYS_mkdirat, SYS_rmdir};
  return std::ranges::find(kCalls, static_cast<long>(call)) != kCalls.end();
}

/// Kills before change `at`, which counts from 0.
inline Killed run_killed(Args args, const fs::path& cwd, std::size_t at, Exchange exchange = Exchange::in_one_step) {
  args = command(std::move(args));
  std::vector<char*> argv;
  for (const auto& arg : args) argv.push_back(const_cast<char*>(arg.c_str()));
  argv.push_back(nullptr);
  const pid_t first = fork();
  if (first == 0) {
    const int null = open("/dev/null", O_RDWR);
    for (const int fd : {0, 1, 2}) dup2(null, fd);
    if (chdir(cwd.c_str()) != 0) _exit(126);
    ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
    raise(SIGSTOP);
    execv(argv[0], argv.data());
    _exit(127);
  }
  Killed result;
  int status = 0;
  waitpid(first, &status, 0);
  constexpr long kOptions =
      PTRACE_O_TRACESYSGOOD | PTRACE_O_TRACEFORK | PTRACE_O_TRACEVFORK | PTRACE_O_TRACECLONE | PTRACE_O_EXITKILL;
  ptrace(PTRACE_SETOPTIONS, first, nullptr, kOptions);
  std::set<pid_t> traced{first}, in_call;
  ptrace(PTRACE_SYSCALL, first, nullptr, nullptr);
  while (!traced.empty()) {
    const pid_t pid = waitpid(-1, &status, __WALL);
    if (pid < 0) break;
    if (!WIFSTOPPED(status)) {
      traced.erase(pid);
      if (pid == first) result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
      continue;
    }
    const bool is_new = traced.insert(pid).second;
    long signal = WSTOPSIG(status);
    if (signal == (SIGTRAP | 0x80)) {
      signal = 0;
      user_regs_struct registers{};
      ptrace(PTRACE_GETREGS, pid, nullptr, &registers);
      const bool enters = in_call.insert(pid).second;
      if (!enters) in_call.erase(pid);
      if (enters && changes_names(registers.orig_rax) && !result.killed && result.changes++ == at) {
        result.killed = true;
        for (const pid_t other : traced) kill(other, SIGKILL);
        continue;
      }
      const bool exchanges = registers.orig_rax == SYS_renameat2 && (registers.r8 & RENAME_EXCHANGE) != 0;
      if (enters && exchanges && exchange == Exchange::refused) {
        registers.orig_rax = ~0ULL;  // no system call: the answer is ENOSYS
        ptrace(PTRACE_SETREGS, pid, nullptr, &registers);
      }
    } else if (status >> 16 != 0 || (is_new && signal == SIGSTOP) || signal == SIGTRAP) {
      signal = 0;  // the start of a process, which is not a signal to it
    }
    if (result.killed) kill(pid, SIGKILL);
    ptrace(PTRACE_SYSCALL, pid, nullptr, signal);
  }
  return result;
}

/// False where the system allows no ptrace(), and with the leak sanitizer, which cannot work in a traced program.
inline bool can_trace(const fs::path& cwd) {
  return run_killed({"--version"}, cwd, static_cast<std::size_t>(-1)).code == 0;
}

}  // namespace scanbench::app_test
