// Starts child processes by fork(), and waits for them by their descriptors.
#include "harness/io/process/child.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <limits>
#include <system_error>
#include <utility>

#include "harness/io/process/deadline.hpp"

namespace scanbench::io {
namespace {

constexpr int kNotBegun = 3;                  // exit code of a child that could not begin
constexpr int kNotExecuted = 127;             // and of one whose program was not executed
constexpr double kKillSeconds = 5.0;          // for a killed child to end
constexpr double kPauseWithoutPidfd = 0.002;  // between two looks at a child whose end no event reports

int waited_children = 0;  // SIGCHLD belongs to the process
struct sigaction old_child_action;

void keep_ended_children() {
  if (waited_children++ > 0) return;
  struct sigaction standard {};
  standard.sa_handler = SIG_DFL;
  ::sigaction(SIGCHLD, &standard, &old_child_action);
}

void restore_child_action() {
  if (--waited_children == 0) ::sigaction(SIGCHLD, &old_child_action, nullptr);
}

/// A copy of the descriptor above those that have a place in the child; -1 for one that is inherited.
int lifted(int descriptor, int mode) {
  if (descriptor == kInherited) return -1;
  const int from = descriptor == kNullDevice ? ::open("/dev/null", mode | O_CLOEXEC) : descriptor;
  const int copy = ::fcntl(from, F_DUPFD_CLOEXEC, kChannel + 1);
  if (copy < 0) ::_exit(kNotBegun);
  return copy;
}

/// Runs in the child. Calls only what is safe in a child of a process with several threads.
void begin_child(const ChildSetting& setting, pid_t parent, unsigned close_flags) {
  if (setting.own_group) ::setpgid(0, 0);
  if (setting.dies_with_parent) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(kNotBegun);  // the parent ended before prctl() was called
  }
  const int input = lifted(setting.input, O_RDONLY);
  const int output = lifted(setting.output, O_WRONLY);
  const int errors = lifted(setting.errors, O_WRONLY);
  const int channel = lifted(setting.channel, 0);
  if (input >= 0) ::dup2(input, STDIN_FILENO);
  if (output >= 0) ::dup2(output, STDOUT_FILENO);
  if (errors >= 0) ::dup2(errors, STDERR_FILENO);
  // A program that is executed has the channel; what a function executes has not.
  if (channel >= 0) ::dup3(channel, kChannel, close_flags == 0 ? O_CLOEXEC : 0);
  ::close_range(channel >= 0 ? kChannel + 1 : kChannel, ~0U, static_cast<int>(close_flags));
}

[[noreturn]] void live_in_child(const std::function<int()>& body) noexcept {
  ::_exit(body());
}

}  // namespace

Child fork_child(const ChildSetting& setting, unsigned close_flags, const std::function<int()>& body) {
  std::fflush(nullptr);  // or the child would print the parent's buffers again
  keep_ended_children();
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid == 0) {
    begin_child(setting, parent, close_flags);
    live_in_child(body);
  }
  if (pid < 0) {
    const int error = errno;
    restore_child_action();
    throw std::system_error(error, std::generic_category());
  }
  if (setting.own_group) ::setpgid(pid, pid);  // called in both processes, because either may be the first
  return {pid, setting.own_group};
}

Child::Child(pid_t pid, bool own_group)
    : pid_(pid),
      own_group_(own_group),
      is_waited_for_(true),
      end_(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0))) {}

Child& Child::operator=(Child&& other) noexcept {
  if (this == &other) return *this;
  end();
  pid_ = std::exchange(other.pid_, -1);
  own_group_ = other.own_group_;
  is_waited_for_ = std::exchange(other.is_waited_for_, false);
  end_ = std::move(other.end_);
  how_ = other.how_;
  return *this;
}

bool Child::has_ended() const {
  if (!is_waited_for_) return true;
  siginfo_t info{};
  return ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 ? info.si_pid == pid_
                                                                                           : errno == ECHILD;
}

bool Child::wait(double seconds, std::initializer_list<PipeReader*> pipes) const {
  const Deadline deadline(seconds);
  while (true) {
    const bool ended = has_ended();  // before the pipes are drained: then all that the process has written is in them
    for (PipeReader* pipe : pipes) pipe->drain();
    const double left = deadline.seconds_left();
    if (ended || left <= 0.0) return ended;
    std::vector<pollfd> events{{end_descriptor(), POLLIN, 0}};
    for (const PipeReader* pipe : pipes) events.push_back({pipe->descriptor(), POLLIN, 0});
    wait_for_events(events, end_.is_open() ? left : std::min(left, kPauseWithoutPidfd));
  }
}

void Child::kill() const {
  if (!is_waited_for_) return;
  if (own_group_) ::kill(-pid_, SIGKILL);
  ::kill(pid_, SIGKILL);
}

const ProcessEnd& Child::reap() {
  if (!is_waited_for_) return how_;
  wait(std::numeric_limits<double>::infinity());
  if (own_group_) ::kill(-pid_, SIGKILL);
  int status = 0;
  rusage usage{};
  if (::wait4(pid_, &status, 0, &usage) == pid_) how_ = process_end(status, usage);
  forget();
  return how_;
}

void Child::end() {
  if (!is_waited_for_) return;
  kill();
  if (wait(kKillSeconds))
    reap();
  else
    forget();
}

void Child::stop(double grace_s) {
  if (!is_waited_for_) return;
  ::kill(pid_, SIGTERM);
  wait(grace_s);
  end();
}

void Child::forget() {
  is_waited_for_ = false;
  end_.close();
  restore_child_action();
}

Child start_child(const ChildSetting& setting, const std::function<int()>& body) {
  return fork_child(setting, 0, [&] {
    const int code = body();
    std::fflush(nullptr);
    return code;
  });
}

Child start_program(const std::vector<std::string>& argv, const ChildSetting& setting,
                    const std::function<void()>& prepare) {
  std::vector<char*> words;
  words.reserve(argv.size() + 1);
  for (const std::string& word : argv)
    words.push_back(const_cast<char*>(word.c_str()));  // NOLINT(*-const-cast): execvp() does not write there
  words.push_back(nullptr);
  // The write end is closed when the program is executed; before, errno comes through the pipe if it is not.
  Pipe failure = make_pipe();
  FileDescriptor failed(::fcntl(failure.write_end.number(), F_DUPFD_CLOEXEC, kChannel + 1));
  failure.write_end.close();
  Child child = fork_child(setting, CLOSE_RANGE_CLOEXEC, [&] {
    if (prepare) prepare();
    ::execvp(words.front(), words.data());
    const int error = errno;
    write_all(failed.number(), std::as_bytes(std::span(&error, 1)));
    return kNotExecuted;
  });
  failed.close();
  int error = 0;
  ssize_t n = 0;
  do {
    n = ::read(failure.read_end.number(), &error, sizeof error);
  } while (n < 0 && errno == EINTR);
  if (n != static_cast<ssize_t>(sizeof error)) return child;
  child.reap();
  throw std::system_error(error, std::generic_category());
}

}  // namespace scanbench::io
