// Child processes: their start, what they inherit, and every way in which they end.
#include "harness/io/process/child.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "harness/io/process/deadline.hpp"
#include "harness/io/process/output_tail.hpp"

namespace scanbench::io {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

[[noreturn]] void sleep_forever() {
  while (true) ::pause();
}

/// A child whose standard output and channel are pipes to the test.
struct Connected {
  Child child;
  PipeReader output, report;
};

Connected connected(const std::function<int()>& body, ChildSetting setting = {.own_group = true}) {
  Pipe output = make_pipe();
  Pipe report = make_pipe();
  setting.output = output.write_end.number();
  setting.channel = report.write_end.number();
  Child child = start_child(setting, body);
  return {std::move(child), {std::move(output.read_end), kOutputKept}, {std::move(report.read_end), kOutputKept}};
}

void send(int descriptor, std::string_view text) {
  write_all(descriptor, std::as_bytes(std::span(text)));
}

/// Waits for the first bytes of the child on its channel, so that what it did before has been done.
void wait_for_report(Connected& run) {
  const Deadline deadline(60.0);
  while (run.report.is_open() && run.report.bytes().empty() && !deadline.is_over()) {
    std::array<pollfd, 1> events{{{run.report.descriptor(), POLLIN, 0}}};
    wait_for_events(events, 1.0);
    run.report.drain();
  }
}

/// Waits until no process has the channel open any more. False after a minute.
bool closes(PipeReader& pipe) {
  const Deadline deadline(60.0);
  while (pipe.is_open() && !deadline.is_over()) {
    std::array<pollfd, 1> events{{{pipe.descriptor(), POLLIN, 0}}};
    wait_for_events(events, 1.0);
    pipe.drain();
  }
  return !pipe.is_open();
}

TEST(Child, EndsWithTheResultOfItsFunction) {
  EXPECT_TRUE(start_child({}, [] { return 0; }).reap().is_success());
  Child child = start_child({}, [] { return 7; });
  EXPECT_TRUE(child.wait(kForever));
  const ProcessEnd& end = child.reap();
  EXPECT_EQ(end.exit_code, 7);
  EXPECT_EQ(end.signal, 0);
  EXPECT_FALSE(end.is_success());
  EXPECT_GT(end.usage.peak_memory_bytes, 1e5);
  EXPECT_EQ(to_text(child.reap()), "with exit code 7") << "it may be asked again";
}

TEST(Child, EndsBySignal) {
  Child child = start_child({}, [] { return ::raise(SIGKILL); });
  EXPECT_EQ(child.reap().signal, SIGKILL);
  EXPECT_EQ(to_text(child.reap()), "by signal 9 (Killed)");
}

TEST(Child, AnExceptionDoesNotReachTheCopyOfTheParent) {
  const std::string output = [] {
    Pipe printed = make_pipe();
    PipeReader text(std::move(printed.read_end), kOutputKept);
    Child child =
        start_child({.output = printed.write_end.number(), .errors = printed.write_end.number()}, []() -> int {
          const rlimit no_core{0, 0};
          ::setrlimit(RLIMIT_CORE, &no_core);
          throw std::system_error(ENOENT, std::generic_category());
        });
    child.wait(kForever, {&text});
    EXPECT_EQ(child.reap().signal, SIGABRT);
    return text.bytes();
  }();
  EXPECT_NE(output.find("No such file"), std::string::npos) << output;
}

TEST(Child, IsStillRunningAtADeadlineAndEndsWithItsOwner) {
  pid_t pid = 0;
  {
    Connected run = connected([]() -> int { sleep_forever(); });
    pid = run.child.pid();
    const double begun = monotonic_seconds();
    EXPECT_FALSE(run.child.wait(0.02, {&run.output}));
    EXPECT_GE(monotonic_seconds() - begun, 0.02);
    EXPECT_FALSE(run.child.has_ended());
  }
  EXPECT_EQ(::kill(pid, 0), -1);
  EXPECT_EQ(errno, ESRCH);
}

TEST(Child, StopsAtSigterm) {
  Connected run = connected([]() -> int {
    std::signal(SIGTERM, [](int) { ::_exit(4); });
    send(kChannel, "x");
    sleep_forever();
  });
  wait_for_report(run);
  run.child.stop(60.0);
  EXPECT_EQ(run.child.reap().exit_code, 4);
}

TEST(Child, IsKilledIfItIgnoresSigterm) {
  Connected run = connected([]() -> int {
    std::signal(SIGTERM, SIG_IGN);
    send(kChannel, "x");
    sleep_forever();
  });
  wait_for_report(run);
  run.child.stop(0.02);
  EXPECT_EQ(run.child.reap().signal, SIGKILL);
}

TEST(Child, ItsEndIsSeenWhileAProcessThatItStartedHoldsItsPipes) {
  Connected run = connected([] {
    if (::fork() == 0) {
      send(kChannel, "x");
      sleep_forever();
    }
    send(STDOUT_FILENO, "done");
    return 0;
  });
  wait_for_report(run);
  EXPECT_TRUE(run.child.wait(60.0, {&run.output}));
  EXPECT_TRUE(run.output.is_open());
  EXPECT_EQ(run.output.bytes(), "done");
  EXPECT_TRUE(run.child.reap().is_success());
  EXPECT_TRUE(closes(run.report)) << "the group ends with its leader";
}

TEST(Child, IsKilledInAGroupThatItHasLeft) {
  Connected run = connected([]() -> int {
    ::setpgid(0, ::getpgid(::getppid()));
    send(kChannel, "x");
    sleep_forever();
  });
  wait_for_report(run);
  run.child.kill();
  EXPECT_EQ(run.child.reap().signal, SIGKILL);
}

TEST(Child, AFloodOfOutputIsDrainedAndItsEndIsKept) {
  Connected run = connected([] {
    const std::string block(1 << 16, 'x');
    for (int i = 0; i < 64; ++i) send(STDOUT_FILENO, block + "\n");
    send(STDOUT_FILENO, "last words\n");
    return 0;
  });
  EXPECT_TRUE(run.child.wait(60.0, {&run.output}));
  EXPECT_TRUE(run.child.reap().is_success());
  EXPECT_GE(run.output.bytes().size(), kOutputKept);
  EXPECT_LE(run.output.bytes().size(), 2 * kOutputKept);
  EXPECT_TRUE(output_tail(run.output.bytes()).ends_with("x\nlast words\n"));
}

TEST(Child, HasNoOpenFileOfItsParent) {
  const FileDescriptor file(::open("/dev/zero", O_RDONLY));
  const FileDescriptor high(::fcntl(file.number(), F_DUPFD, 300));
  const auto open_files = [] {
    std::string open;
    for (int fd = 0; fd < 1024; ++fd)
      if (::fcntl(fd, F_GETFD) >= 0) open += std::to_string(fd) + " ";
    char byte = 0;
    send(STDOUT_FILENO, open + (::read(STDIN_FILENO, &byte, 1) == 0 ? "empty" : "not empty"));
    return 0;
  };
  Connected run = connected(open_files);
  run.child.wait(60.0, {&run.output});
  EXPECT_EQ(run.output.bytes(), "0 1 2 3 empty");
}

TEST(Child, FindsItsPipesWhateverTheirNumbersAreInTheParent) {
  // In a child without standard descriptors, the pipes of its own child have the numbers 0 to 3.
  Connected run = connected([] {
    const FileDescriptor report(::fcntl(kChannel, F_DUPFD, 100));
    for (int fd = 0; fd < 4; ++fd) ::close(fd);
    Connected inner = connected([] {
      send(STDOUT_FILENO, "output");
      send(kChannel, "report");
      return 0;
    });
    inner.child.wait(60.0, {&inner.output, &inner.report});
    send(report.number(), inner.output.bytes() + " " + inner.report.bytes());
    return 0;
  });
  run.child.wait(60.0, {&run.output, &run.report});
  EXPECT_EQ(run.report.bytes(), "output report");
}

TEST(Child, CanBeWaitedForWhereTheEndsOfChildrenAreIgnored) {
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  {
    Child first = start_child({}, [] { return 5; });
    Child second = start_child({}, [] { return 6; });
    EXPECT_EQ(first.reap().exit_code, 5);
    EXPECT_EQ(second.reap().exit_code, 6);
  }
  EXPECT_TRUE(std::signal(SIGCHLD, before) == SIG_IGN);
}

TEST(Child, MayBeMoved) {
  std::vector<Child> children;
  for (int code = 1; code <= 3; ++code) children.push_back(start_child({}, [code] { return code; }));
  children.front().reap();
  children.erase(children.begin());
  ASSERT_EQ(children.size(), 2U);
  EXPECT_EQ(children[0].reap().exit_code, 2);
  EXPECT_EQ(children[1].reap().exit_code, 3);
}

TEST(Program, RunsWithItsArgumentsAndTheChannel) {
  Pipe output = make_pipe();
  Pipe channel = make_pipe();
  PipeReader text(std::move(output.read_end), kOutputKept);
  PipeReader report(std::move(channel.read_end), kOutputKept);
  Child child = start_program({"sh", "-c", "printf \"$1 $WORD\"; printf three >&3", "sh", "one"},
                              {.output = output.write_end.number(), .channel = channel.write_end.number()},
                              [] { ::setenv("WORD", "two", 1); });
  EXPECT_TRUE(child.wait(60.0, {&text, &report}));
  EXPECT_TRUE(child.reap().is_success());
  EXPECT_EQ(text.bytes(), "one two");
  EXPECT_EQ(report.bytes(), "three");
}

TEST(Program, HasNoOpenFileOfItsParent) {
  const FileDescriptor file(::open("/dev/zero", O_RDONLY));
  const FileDescriptor high(::fcntl(file.number(), F_DUPFD, 9));
  const std::string test = "test ! -e /proc/self/fd/" + std::to_string(file.number()) + " && test ! -e /proc/self/fd/" +
                           std::to_string(high.number());
  EXPECT_TRUE(start_program({"sh", "-c", test}, {}).reap().is_success());
}

TEST(Program, ThatDoesNotExistIsAnErrorWithItsNumber) {
  const auto error_of = [](const std::string& name) {
    try {
      start_program({name}, {});
    } catch (const std::system_error& error) {
      return error.code().value();
    }
    return 0;
  };
  EXPECT_EQ(error_of("no_program_has_this_name"), ENOENT);
  EXPECT_EQ(error_of("/no/such/folder/program"), ENOENT);
  EXPECT_EQ(error_of("/dev/null"), EACCES);
}

TEST(Program, ThatDoesNotExistIsAnErrorWhereTheEndsOfChildrenAreIgnored) {
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  EXPECT_THROW(start_program({"no_program_has_this_name"}, {}), std::system_error);
  EXPECT_TRUE(std::signal(SIGCHLD, before) == SIG_IGN);
}

}  // namespace
}  // namespace scanbench::io
