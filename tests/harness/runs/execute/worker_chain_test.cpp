// Several tasks in one worker process, and the reports that it sends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <unistd.h>

#include "core/error.hpp"
#include "harness/runs/execute/runner.hpp"
#include "harness/runs/execute/worker.hpp"
#include "harness/runs/execute/worker_report.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::runs {
namespace {

using ::testing::HasSubstr;

std::map<std::size_t, WorkerOutcome> outcomes_of(const std::vector<WorkerTask>& tasks) {
  WorkerPool pool;
  pool.start(tasks);
  std::map<std::size_t, WorkerOutcome> outcomes;
  while (pool.running() > 0)
    for (auto& finished : pool.wait()) outcomes.emplace(finished.id, std::move(finished.outcome));
  return outcomes;
}

std::string bytes_at(std::size_t megabytes) {
  const std::size_t size = megabytes << 20;
  const auto block = std::make_unique<char[]>(size);
  std::memset(block.get(), 1, size);
  return std::to_string(block[size / 2]);
}

TEST(WorkerChain, GivesEachTaskItsOutcomeAndWhatTheOneBeforeItLeftInMemory) {
  std::string left;
  const auto outcomes = outcomes_of({{7, [&] { return left = "made"; }, {}}, {3, [&] { return left + " used"; }, {}}});
  ASSERT_EQ(outcomes.size(), 2u);
  EXPECT_EQ(outcomes.at(7).status, CellStatus::ok);
  EXPECT_EQ(outcomes.at(7).message, "made");
  EXPECT_EQ(outcomes.at(3).status, CellStatus::ok);
  EXPECT_EQ(outcomes.at(3).message, "made used");
  EXPECT_EQ(left, "");  // nothing comes back into this process
}

TEST(WorkerChain, EndsAtTheFirstTaskThatIsNotOk) {
  const auto thrown = outcomes_of(
      {{0, []() -> std::string { throw ConfigError("bad file"); }, {}}, {1, [] { return std::string("never"); }, {}}});
  ASSERT_EQ(thrown.size(), 1u);
  EXPECT_TRUE(thrown.at(0).bad_input);
  EXPECT_EQ(thrown.at(0).message, "bad file");

  const auto crashed = outcomes_of({{0, [] { return std::string("made"); }, {}},
                                    {1,
                                     []() -> std::string {
                                       std::signal(SIGSEGV, SIG_DFL);  // a sanitizer would report it
                                       ::raise(SIGSEGV);
                                       return "";
                                     },
                                     {}}});
  ASSERT_EQ(crashed.size(), 2u);
  EXPECT_EQ(crashed.at(0).status, CellStatus::ok);
  EXPECT_EQ(crashed.at(1).status, CellStatus::crashed);
  EXPECT_THAT(crashed.at(1).message, HasSubstr("signal 11"));
}

TEST(WorkerChain, HoldsEachTaskToItsOwnTime) {
  const auto hang = []() -> std::string {
    while (true) ::pause();
  };
  const auto outcomes = outcomes_of({{0, [] { return std::string(); }, {.seconds = 600}}, {1, hang, {.seconds = 0.2}}});
  ASSERT_EQ(outcomes.size(), 2u);
  EXPECT_EQ(outcomes.at(0).status, CellStatus::ok);
  EXPECT_EQ(outcomes.at(1).status, CellStatus::timeout);
  EXPECT_THAT(outcomes.at(1).message, HasSubstr("0.2 s"));

  const auto first = outcomes_of({{0, hang, {.seconds = 0.2}}, {1, [] { return std::string(); }, {}}});
  ASSERT_EQ(first.size(), 1u);
  EXPECT_EQ(first.at(0).status, CellStatus::timeout);
}

TEST(WorkerChain, CountsTheMemoryOfEachTaskAlone) {
  const auto outcomes =
      outcomes_of({{0, [] { return bytes_at(200); }, {}}, {1, [] { return std::string("small"); }, {}}});
  EXPECT_GT(outcomes.at(0).peak_memory_bytes, 200e6);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they keep freed memory
  EXPECT_LT(outcomes.at(1).peak_memory_bytes, 100e6);
#endif
}

TEST(WorkerChain, CountsTheTimeOfEachTaskAlone) {
  const auto burn = [](double seconds) {
    return [seconds] {
      const auto used = [] {
        rusage usage{};
        getrusage(RUSAGE_SELF, &usage);
        return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
               1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
      };
      const double end = used() + seconds;
      while (used() < end) {
      }
      return std::string();
    };
  };
  const auto outcomes = outcomes_of({{0, burn(0.3), {}}, {1, burn(0.1), {}}});
  EXPECT_GE(outcomes.at(0).cpu_seconds, 0.3);
  EXPECT_GE(outcomes.at(1).cpu_seconds, 0.1);
  EXPECT_LT(outcomes.at(1).cpu_seconds, 0.3);
}

TEST(WorkerChain, TheLastTaskCannotRaiseItsLimits) {
  const auto raise_limit = [] {
    const rlimit wanted{RLIM_INFINITY, RLIM_INFINITY};
    // The superuser may raise any limit.
    const bool refused = ::getuid() == 0 || ::setrlimit(RLIMIT_CPU, &wanted) != 0;
    return std::string(refused ? "refused" : "raised");
  };
  const auto outcomes = outcomes_of({{0, [] { return std::string(); }, {.seconds = 1}}, {1, raise_limit, {}}});
  EXPECT_EQ(outcomes.at(1).message, "refused");
}

TEST(WorkerChain, ACellAloneWithItsRecordingHasTheBytesThatItHasBesideOthers) {
  using fixtures::extract_with;
  using fixtures::run_here;
  using fixtures::scenario_with;
  const support::TemporaryFolder folder;
  const study::PipelineSpec wanted = extract_with("a", "test_line");
  run_here({scenario_with("s", {wanted, extract_with("b", "test_throw")}, {1, 2})}, {.out = folder.path() / "both"});
  run_here({scenario_with("s", {wanted}, {1, 2})}, {.out = folder.path() / "alone"});
  const auto alone = fixtures::artefacts(folder.path() / "alone");
  const auto both = fixtures::artefacts(folder.path() / "both");
  std::size_t compared = 0;
  for (const auto& [path, bytes] : alone) {
    if (!path.starts_with("cells/") && !path.starts_with("recordings/")) continue;
    EXPECT_EQ(both.at(path), bytes) << path;
    ++compared;
  }
  EXPECT_GT(compared, 20u);
}

TEST(WorkerReport, ComesBackFromItsBytesAndLeavesTheRest) {
  for (const CellStatus status : {CellStatus::ok, CellStatus::failed, CellStatus::out_of_memory})
    for (const std::string message : {"", "a line\nanother 7 8\n", "1 0 0 1 1 3\nabc"}) {
      const WorkerOutcome sent{.status = status,
                               .message = message,
                               .cpu_seconds = 0.125,
                               .peak_memory_bytes = 4096.0,
                               .bad_input = message.empty(),
                               .system_error = !message.empty()};
      TaskOutput output;
      output.content_hash = "c0ffee";
      output.summary = "s,a,1," + message + "\n";
      output.file_hashes = message + message;
      std::string bytes = report_bytes({sent, output}) + "rest";
      const auto received = take_report(bytes);
      ASSERT_TRUE(received);
      EXPECT_EQ(received->outcome.status, status);
      EXPECT_EQ(received->outcome.message, message);
      EXPECT_EQ(received->outcome.cpu_seconds, 0.125);
      EXPECT_EQ(received->outcome.peak_memory_bytes, 4096.0);
      EXPECT_EQ(received->outcome.bad_input, sent.bad_input);
      EXPECT_EQ(received->outcome.system_error, sent.system_error);
      EXPECT_EQ(received->output.content_hash, output.content_hash);
      EXPECT_EQ(received->output.summary, output.summary);
      EXPECT_EQ(received->output.file_hashes, output.file_hashes);
      EXPECT_EQ(bytes, "rest");
    }
}

TEST(WorkerReport, IsNotTakenBeforeItIsWholeNorFromOtherBytes) {
  const std::string whole = report_bytes({{.status = CellStatus::ok, .message = "message"}});
  for (std::size_t size = 0; size < whole.size(); ++size) {
    std::string part = whole.substr(0, size);
    EXPECT_FALSE(take_report(part)) << size;
    EXPECT_EQ(part.size(), size);
  }
  for (std::string other : {"ok\n", "0 0 0 0 0 0 0 0\n", "99 0 0 0 0 0 0 0 0\n", "-1 0 0 0 0 0 0 0 0\n",
                            "0 0 0 0 0 1e30 0 0 0\n", "0 0 0 0 0 0 0 0 inf\n", "0 0 0 nan 0 0 0 0 0\n", "\n\n\n\n",
                            "0 0 0 0 0 x 0 0 0\nyyy", "0 0 0 0 0 2 2 2 2\nsevenby"})
    EXPECT_FALSE(take_report(other)) << other;
  std::string without_a_line(1 << 20, ' ');
  EXPECT_FALSE(take_report(without_a_line));
}

}  // namespace
}  // namespace scanbench::runs
