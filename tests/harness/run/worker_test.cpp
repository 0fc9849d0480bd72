#include "harness/run/worker.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <memory>
#include <new>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.hpp"
#include "harness/run/pipeline.hpp"
#include "harness/store/cell_status.hpp"

namespace scanbench::harness {
namespace {

using ::testing::HasSubstr;

WorkerOutcome outcome_of(const std::function<std::string()>& task, const WorkerLimits& limits = {}) {
  WorkerPool pool;
  pool.start(0, task, limits);
  const auto finished = pool.wait();
  return finished.empty() ? WorkerOutcome{} : finished.front().outcome;
}

TEST(Worker, BringsBackWhatTheTaskReturnsHoweverLong) {
  const std::string text(3 << 20, 'x');
  const WorkerOutcome outcome = outcome_of([&] { return text; });
  EXPECT_EQ(outcome.status, CellStatus::ok);
  EXPECT_EQ(outcome.message, text);
  EXPECT_GT(outcome.peak_memory_bytes, 1e6);
  EXPECT_GT(outcome.wall_seconds, 0.0);
}

TEST(Worker, TellsExceptionsApart) {
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
  int alive[2];
  ASSERT_EQ(::pipe(alive), 0);
  const auto outcome = outcome_of(
      [&]() -> std::string {
        ::fork();  // both sleep
        while (true) ::usleep(10000);
      },
      {.seconds = 0.2});
  EXPECT_EQ(outcome.status, CellStatus::timeout);
  EXPECT_EQ(outcome.message, "killed after the limit of 0.2 s");
  // The pipe's end shows when the last process that holds it, the grandchild, is gone.
  ::close(alive[1]);
  char byte = 0;
  EXPECT_EQ(::read(alive[0], &byte, 1), 0);
  ::close(alive[0]);
}

TEST(Worker, LeavesNothingRunningBehindATaskThatHasEnded) {
  int alive[2];
  ASSERT_EQ(::pipe(alive), 0);
  const auto outcome = outcome_of([&]() -> std::string {
    if (::fork() == 0) {
      while (true) ::usleep(10000);
    }
    return "done";
  });
  EXPECT_EQ(outcome.message, "done");
  ::close(alive[1]);
  char byte = 0;
  EXPECT_EQ(::read(alive[0], &byte, 1), 0);
  ::close(alive[0]);
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
  // Where the exception meets a noexcept, the process ends by abort().
  const auto outcome = outcome_of(
      [&]() -> std::string {
        [&]() noexcept { eat(300); }();
        return "";
      },
      {.memory_bytes = 200e6});
  EXPECT_EQ(outcome.status, CellStatus::out_of_memory) << outcome.message;
}

TEST(Worker, TakesAKillBySomebodyElseForWantOfMemory) {
  EXPECT_EQ(outcome_of([]() -> std::string {
              ::raise(SIGKILL);
              return "";
            }).status,
            CellStatus::out_of_memory);
}

TEST(Worker, RunsSeveralAtOnce) {
  // Each waits for a byte that the other one writes: one after the other, they would never end.
  int a[2];
  int b[2];
  ASSERT_EQ(::pipe(a), 0);
  ASSERT_EQ(::pipe(b), 0);
  const auto task = [](int to, int from) -> std::string {
    char byte = 'x';
    if (::write(to, &byte, 1) != 1 || ::read(from, &byte, 1) != 1) return "no";
    return "met";
  };
  WorkerPool pool;
  pool.start(0, [&] { return task(a[1], b[0]); }, {.seconds = 60});
  pool.start(1, [&] { return task(b[1], a[0]); }, {.seconds = 60});
  std::size_t met = 0;
  while (pool.running() > 0)
    for (const auto& finished : pool.wait()) met += finished.outcome.message == "met";
  EXPECT_EQ(met, 2u);
  for (const int fd : {a[0], a[1], b[0], b[1]}) ::close(fd);
}

TEST(Worker, AnInterruptEndsTheWaitAndTheChildrenGoWithThePool) {
  int alive[2];
  ASSERT_EQ(::pipe(alive), 0);
  {
    WorkerPool pool;
    pool.start(0,
               []() -> std::string {
                 while (true) ::usleep(10000);
               },
               {});
    ::raise(SIGINT);
    EXPECT_TRUE(pool.wait().empty());
    EXPECT_TRUE(pool.interrupted());
    EXPECT_EQ(pool.running(), 1u);
  }
  ::close(alive[1]);
  char byte = 0;
  EXPECT_EQ(::read(alive[0], &byte, 1), 0);
  ::close(alive[0]);
}

TEST(CellStatus, HasTheNamesOfTheContract) {
  for (const char* name : {"ok", "skipped", "invalid", "failed", "crashed", "timeout", "out_of_memory"})
    EXPECT_EQ(to_string(cell_status_from(name)), name);
  EXPECT_THROW(cell_status_from("fine"), ConfigError);
}

}  // namespace
}  // namespace scanbench::harness
