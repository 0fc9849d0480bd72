// A module that does what a module must not do.
#include <fcntl.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

/// Starts a daemon while the library is loaded, if a test names the file for its number.
const bool kDaemonWhileLoaded = [] {
  const char* file = std::getenv("HOSTILE_DAEMON");
  if (file == nullptr || ::fork() != 0) return false;
  ::setsid();
  const int number = ::open(file, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  const std::string text = std::to_string(::getpid());
  [[maybe_unused]] const ssize_t written = ::write(number, text.data(), text.size());
  ::sleep(600);
  ::_exit(0);
}();

constexpr int kStorm = 500;  // processes: a storm that a machine survives

enum class How {
  nothing,
  segfault,
  abort,
  exit,
  loop,
  memory,
  fork_storm,
  output,
  close_descriptors,
  kill_parent,
  kill_itself,
  daemon,
  network
};

[[noreturn]] void storm() {
  for (int i = 0; i < kStorm; ++i) {
    const pid_t pid = ::fork();
    if (pid == 0) {
      ::sleep(100);
      ::_exit(0);
    }
    if (pid < 0) throw std::runtime_error("no process after " + std::to_string(i));
  }
  throw std::runtime_error("nothing stopped the storm");
}

/// Leaves a process in a session of its own, which has written its number to standard error, and aborts.
void leave_daemon() {
  int told[2];
  if (::pipe(told) != 0) return;
  if (::fork() != 0) {
    char byte = 0;
    if (::read(told[0], &byte, 1) == 1) ::abort();
    return;
  }
  ::setsid();
  if (::fork() != 0) ::_exit(0);
  const std::string text = "daemon " + std::to_string(::getpid()) + "\n";
  if (::write(STDERR_FILENO, text.data(), text.size()) < 0 || ::write(told[1], "x", 1) != 1) ::_exit(1);
  for (int fd = 0; fd < 10; ++fd) ::close(fd);
  ::sleep(100);
  ::_exit(0);
}

void misbehave(How how) {
  switch (how) {
    case How::nothing:
      return;
    case How::segfault: {
      volatile int* nowhere = nullptr;
      *nowhere = 1;
      return;
    }
    case How::abort:
      ::abort();
    case How::exit:
      std::exit(0);
    case How::loop:
      for (volatile unsigned i = 0;;) i = i + 1;
    case How::memory:
      for (std::vector<std::vector<char>> all;;) all.emplace_back(64U << 20, 'x');
    case How::fork_storm:
      storm();
    case How::output: {
      // Two gigabytes, or what this machine takes in a second: the time limit of the cell has its own case.
      using Clock = std::chrono::steady_clock;
      const std::string block(1U << 20, 'x');
      const auto end = Clock::now() + std::chrono::seconds(1);
      for (int i = 0; i < 2048 && Clock::now() < end; ++i)
        if (::write(STDOUT_FILENO, block.data(), block.size()) < 0) break;
      throw std::runtime_error("written");
    }
    case How::close_descriptors:
      for (int fd = 0; fd < 100; ++fd) ::close(fd);
      return;
    case How::kill_parent:
      ::kill(::getppid(), SIGTERM);
      ::kill(::getppid(), SIGINT);
      ::sleep(100);
      return;
    case How::kill_itself:
      ::kill(::getpid(), SIGKILL);
      return;
    case How::daemon:
      leave_daemon();
      return;
    case How::network: {
      const int fd = ::socket(AF_INET, SOCK_DGRAM, 0);
      sockaddr_in here{};
      here.sin_family = AF_INET;
      here.sin_port = htons(9);
      here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
      const bool reached = ::connect(fd, reinterpret_cast<const sockaddr*>(&here), sizeof here) == 0;
      throw std::runtime_error(reached ? "reached the network" : std::strerror(errno));
    }
  }
}

class Hostile final : public LineExtractor {
 public:
  struct Params {
    How how = How::nothing;
    static auto fields() {
      return std::tuple{choice("how", &Params::how,
                               {{How::nothing, "nothing"},
                                {How::segfault, "segfault"},
                                {How::abort, "abort"},
                                {How::exit, "exit"},
                                {How::loop, "loop"},
                                {How::memory, "memory"},
                                {How::fork_storm, "fork_storm"},
                                {How::output, "output"},
                                {How::close_descriptors, "close_descriptors"},
                                {How::kill_parent, "kill_parent"},
                                {How::kill_itself, "kill_itself"},
                                {How::daemon, "daemon"},
                                {How::network, "network"}},
                               "what it does")};
    }
  };
  explicit Hostile(Params params) : params_(params) {}

  ScanLines extract(const Scan& scan, Trace&) const override {
    misbehave(params_.how);
    return {{}, std::vector<int>(static_cast<std::size_t>(scan.beams()), -1)};
  }

 private:
  Params params_;
};

SCANBENCH_REGISTER(LineExtractor, Hostile,
                   {.name = "hostile", .summary = "does what a module must not do", .reference = "none"});

}  // namespace
}  // namespace scanbench
