// Worker processes: results, exceptions, crashes and timeouts.
#include "harness/runs/execute/worker.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.hpp"
#include "harness/io/files/system_error.hpp"
#include "harness/runs/execute/pipeline.hpp"
#include "harness/runs/store/cell_status.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::runs {
namespace {

using ::testing::HasSubstr;

WorkerOutcome outcome_of(const std::function<std::string()>& task, const WorkerLimits& limits = {}) {
  WorkerPool pool;
  pool.start(0, task, limits);
  const auto finished = pool.wait();
  return finished.empty() ? WorkerOutcome{} : finished.front().outcome;
}

/// A named pipe that a task opens by its name, because it inherits no descriptor.
class Fifo {
 public:
  Fifo() : path_((folder_.path() / "fifo").string()) {
    if (::mkfifo(path_.c_str(), 0600) != 0) throw std::runtime_error("no named pipe");
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_NONBLOCK);
  }
  ~Fifo() { ::close(descriptor_); }
  Fifo(const Fifo&) = delete;
  Fifo& operator=(const Fifo&) = delete;
  const char* path() const { return path_.c_str(); }

  /// In a task: a writer from now until its process, and all that it starts, have ended.
  void hold() const {
    const int held = ::open(path(), O_WRONLY);
    if (::write(held, "x", 1) != 1) ::_exit(9);
  }
  /// Waits until no process has it open. False if none ever had.
  bool is_released() {
    const int reader = ::open(path(), O_RDONLY | O_NONBLOCK);
    ::close(descriptor_);
    descriptor_ = reader;
    ::fcntl(reader, F_SETFL, 0);
    char bytes[2];
    return ::read(reader, bytes, 2) == 1 && ::read(reader, bytes, 2) == 0;
  }

 private:
  support::TemporaryFolder folder_;
  std::string path_;
  int descriptor_ = -1;
};

TEST(Worker, BringsBackWhatTheTaskReturnsHoweverLong) {
  const std::string text(3 << 20, 'x');
  const WorkerOutcome outcome = outcome_of([&] { return text; });
  EXPECT_EQ(outcome.status, CellStatus::ok);
  EXPECT_EQ(outcome.message, text);
  EXPECT_GT(outcome.peak_memory_bytes, 1e6);
  EXPECT_GT(outcome.wall_seconds, 0.0);
}

TEST(Worker, DistinguishesExceptions) {
  const auto failed = outcome_of([]() -> std::string { throw std::runtime_error("reason"); });
  EXPECT_EQ(failed.status, CellStatus::failed);
  EXPECT_EQ(failed.message, "reason");
  EXPECT_FALSE(failed.bad_input);
  const auto bad = outcome_of([]() -> std::string { throw ConfigError("wrong file"); });
  EXPECT_EQ(bad.status, CellStatus::failed);
  EXPECT_TRUE(bad.bad_input);
  EXPECT_EQ(outcome_of([]() -> std::string { throw InvalidResult("r"); }).status, CellStatus::invalid);
  EXPECT_EQ(outcome_of([]() -> std::string { throw std::bad_alloc(); }).status, CellStatus::out_of_memory);
  EXPECT_EQ(outcome_of([]() -> std::string { throw 5; }).status, CellStatus::failed);
}

TEST(Worker, ReportsACrashWithTheSignalAndTheLastWords) {
  const auto outcome = outcome_of([]() -> std::string {
    std::fputs("last words", stderr);
    std::signal(SIGSEGV, SIG_DFL);
    ::raise(SIGSEGV);
    return "";
  });
  EXPECT_EQ(outcome.status, CellStatus::crashed);
  EXPECT_THAT(outcome.message, HasSubstr("signal 11"));
  EXPECT_THAT(outcome.message, HasSubstr("last words"));
}

TEST(Worker, ReportsAnEndWithoutAResult) {
  const auto outcome = outcome_of([]() -> std::string { ::_exit(0); });
  EXPECT_EQ(outcome.status, CellStatus::crashed);
  EXPECT_THAT(outcome.message, HasSubstr("without a result"));
}

TEST(Worker, KillsAHangWithAllThatItStarted) {
  Fifo alive;
  const auto outcome = outcome_of(
      [&]() -> std::string {
        alive.hold();
        ::fork();  // both sleep
        while (true) ::usleep(10000);
      },
      {.seconds = 0.2});
  EXPECT_EQ(outcome.status, CellStatus::timeout);
  EXPECT_EQ(outcome.message, "took longer than the limit of 0.2 s");
  EXPECT_TRUE(alive.is_released());
}

TEST(Worker, KillsATaskThatHasLeftItsProcessGroup) {
  const auto outcome = outcome_of(
      []() -> std::string {
        if (::setpgid(0, ::getpgid(::getppid())) != 0) return "could not leave";
        while (true) ::usleep(10000);
      },
      {.seconds = 0.2});
  EXPECT_EQ(outcome.status, CellStatus::timeout) << outcome.message;
}

TEST(Worker, LeavesNothingRunningBehindATaskThatHasEnded) {
  Fifo alive;
  const auto outcome = outcome_of([&]() -> std::string {
    alive.hold();
    if (::fork() == 0) {
      while (true) ::usleep(10000);
    }
    return "done";
  });
  EXPECT_EQ(outcome.message, "done");
  EXPECT_TRUE(alive.is_released());
}

TEST(Worker, GivesATaskNoOpenFileOfTheParentAndAnEmptyInput) {
  const support::TemporaryFolder folder;
  const int lock = ::open(folder.path().c_str(), O_RDONLY | O_DIRECTORY);
  const int high = ::fcntl(lock, F_DUPFD, 200);
  const auto outcome = outcome_of([&]() -> std::string {
    std::string open;
    for (int fd = 0; fd < 1024; ++fd)
      if (::fcntl(fd, F_GETFD) >= 0) open += std::to_string(fd) + " ";
    char byte = 0;
    return open + (::read(STDIN_FILENO, &byte, 1) == 0 ? "empty" : "not empty");
  });
  EXPECT_EQ(outcome.message, "0 1 2 3 empty");
  ::close(lock);
  ::close(high);
}

TEST(Worker, HoldsATaskToLimitsThatItCannotRaise) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers reserve address space without end";
#endif
  const auto hard = [](__rlimit_resource resource) {
    rlimit now{};
    ::getrlimit(resource, &now);
    return static_cast<double>(now.rlim_max);
  };
  const auto outcome = outcome_of(
      [&]() -> std::string { return hard(RLIMIT_AS) < 1e12 && hard(RLIMIT_CPU) < 1e6 ? "limited" : "unlimited"; },
      {.seconds = 10, .memory_bytes = 1e9});
  EXPECT_EQ(outcome.message, "limited");
}

TEST(Worker, BoundsWhatATaskReportsAndTheMessageOfAnException) {
  const auto report = outcome_of([]() -> std::string { return std::string(40 << 20, 'x'); });
  EXPECT_EQ(report.status, CellStatus::failed);
  EXPECT_LT(report.message.size(), 1000u);
  const auto message = outcome_of([]() -> std::string { throw std::runtime_error(std::string(10 << 20, 'x')); });
  EXPECT_EQ(message.status, CellStatus::failed);
  EXPECT_LT(message.message.size(), 20000u);
}

TEST(Worker, DistinguishesErrorsOfTheSystem) {
  const auto full = outcome_of([]() -> std::string { throw io::SystemError("the disk is full"); });
  EXPECT_TRUE(full.system_error);
  EXPECT_FALSE(full.bad_input);
  EXPECT_EQ(full.message, "the disk is full");
  EXPECT_FALSE(outcome_of([]() -> std::string { throw ConfigError("wrong"); }).system_error);
}

TEST(Worker, WaitsForItsChildrenWhereTheirEndsAreIgnored) {
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(outcome_of([]() -> std::string { return "done"; }).message, "done");
  EXPECT_TRUE(std::signal(SIGCHLD, before) == SIG_IGN);
}

TEST(Worker, HoldsTheMemoryLimit) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers reserve address space without end";
#endif
  const auto eat = [](std::size_t megabytes) -> std::string {
    std::vector<std::unique_ptr<char[]>> hoard;
    for (std::size_t i = 0; i < megabytes; ++i) hoard.push_back(std::make_unique<char[]>(1 << 20));
    return "eaten";
  };
  EXPECT_EQ(outcome_of([&] { return eat(300); }, {.memory_bytes = 200e6}).status, CellStatus::out_of_memory);
  EXPECT_EQ(outcome_of([&] { return eat(100); }, {.memory_bytes = 200e6}).status, CellStatus::ok);
  // An exception in a noexcept function ends the process by abort().
  const auto outcome = outcome_of(
      [&]() -> std::string {
        [&]() noexcept { eat(300); }();
        return "";
      },
      {.memory_bytes = 200e6});
  EXPECT_EQ(outcome.status, CellStatus::out_of_memory) << outcome.message;
}

TEST(Worker, AKillThatTheSystemDidNotCauseIsACrash) {
  const WorkerOutcome outcome = outcome_of([]() -> std::string {
    ::raise(SIGKILL);
    return "";
  });
  EXPECT_EQ(outcome.status, CellStatus::crashed);
  EXPECT_THAT(outcome.message, HasSubstr("signal 9"));
}

TEST(Worker, AnInterruptFromATaskIsAFaultOfTheTask) {
  WorkerPool pool;
  pool.start(0,
             []() -> std::string {
               ::kill(::getppid(), SIGTERM);
               ::sleep(100);
               return "";
             },
             {});
  const auto finished = pool.wait();
  EXPECT_FALSE(pool.interrupted());
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].outcome.status, CellStatus::crashed);
  EXPECT_THAT(finished[0].outcome.message, HasSubstr("sent a signal to scanbench itself"));
}

TEST(Worker, AProcessInASessionOfItsOwnEndsWithItsTask) {
  Fifo fifo;
  const WorkerOutcome outcome = outcome_of([&]() -> std::string {
    if (::fork() == 0) {
      ::setsid();
      if (::fork() != 0) ::_exit(0);
      fifo.hold();
      ::sleep(100);
      ::_exit(0);
    }
    ::usleep(100000);
    return "";
  });
  EXPECT_EQ(outcome.status, CellStatus::ok);
  EXPECT_TRUE(fifo.is_released());
}

TEST(Worker, RunsSeveralAtOnce) {
  // Each waits for a byte that the other one writes, so they would never end one after the other.
  const Fifo a;
  const Fifo b;
  const auto task = [](const char* to, const char* from) -> std::string {
    const int out = ::open(to, O_RDWR);
    const int in = ::open(from, O_RDWR);
    char byte = 'x';
    if (::write(out, &byte, 1) != 1 || ::read(in, &byte, 1) != 1) return "no";
    return "met";
  };
  WorkerPool pool;
  pool.start(0, [&] { return task(a.path(), b.path()); }, {.seconds = 60});
  pool.start(1, [&] { return task(b.path(), a.path()); }, {.seconds = 60});
  std::size_t met = 0;
  while (pool.running() > 0)
    for (const auto& finished : pool.wait()) met += finished.outcome.message == "met";
  EXPECT_EQ(met, 2u);
}

TEST(Worker, AnInterruptEndsTheWaitAndTheChildrenEndWithThePool) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    Fifo alive;
    {
      WorkerPool pool;
      pool.start(0,
                 [&]() -> std::string {
                   alive.hold();
                   while (true) ::usleep(10000);
                 },
                 {});
      for (int i = 0; i < 60000; ++i) {  // until the child has begun
        pollfd waiting{::open(alive.path(), O_RDONLY | O_NONBLOCK), POLLIN, 0};
        const bool held = ::poll(&waiting, 1, 1) == 1;
        ::close(waiting.fd);
        if (held) break;
      }
      ::raise(signal);
      EXPECT_TRUE(pool.wait().empty());
      EXPECT_TRUE(pool.interrupted());
      EXPECT_EQ(pool.running(), 1u);
    }
    EXPECT_TRUE(alive.is_released());
  }
}

TEST(CellStatus, HasTheNamesOfTheContract) {
  for (const char* name : {"ok", "skipped", "invalid", "failed", "crashed", "timeout", "out_of_memory"})
    EXPECT_EQ(to_string(cell_status_from(name)), name);
  EXPECT_THROW(cell_status_from("fine"), ConfigError);
}

}  // namespace
}  // namespace scanbench::runs
