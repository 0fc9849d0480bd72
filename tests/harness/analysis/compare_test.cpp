// Comparison of two runs: pairs, verdicts, and rows that fail or are missing.
#include "harness/analysis/compare.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "harness/files/atomic_file.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::harness {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using testing::extract_with;
using ::testing::HasSubstr;
using testing::run_here;
using testing::scenario_with;

// With skip = n, n more beams of each of the five frames have no line: test_unlabelled grows by 5 n; the tolerance
// is 1.
fs::path run_with_skip(const fs::path& out, std::int64_t skip, const std::string& second = "test_line",
                       std::vector<std::uint64_t> seeds = {1, 2}) {
  run_here({scenario_with("s", {extract_with("a", "test_line", {{"skip", skip}}), extract_with("b", second)}, seeds)},
           {.out = out, .jobs = 2});
  return out;
}

TEST(Compare, OfTheSameSeedsAndAlgorithmsIsExactlyZero) {
  const testing::TemporaryFolder folder;
  const Comparison c = compare_runs(run_with_skip(folder.path() / "a", 0), run_with_skip(folder.path() / "b", 0));
  EXPECT_EQ(c.exit_code(), 0);
  EXPECT_EQ(c.rows.size(), 2u * 2u * 3u);
  for (const auto& row : c.rows) {
    EXPECT_EQ(row.difference, 0.0);
    EXPECT_EQ(row.verdict, Verdict::same);
  }
  EXPECT_TRUE(c.notes.empty());
}

TEST(Compare, PairsBySeedAndJudgesByDirectionAndTolerance) {
  const testing::TemporaryFolder folder;
  const fs::path a = run_with_skip(folder.path() / "a", 0);
  const fs::path b = run_with_skip(folder.path() / "b", 1);
  const Comparison worse = compare_runs(a, b);
  EXPECT_EQ(worse.exit_code(), 1);
  EXPECT_EQ(worse.counts.at(Verdict::worse), 2);  // pipeline a, both seeds; b is unchanged
  for (const auto& row : worse.rows) {
    if (row.metric != "test_unlabelled") continue;
    EXPECT_EQ(row.difference, row.cell.pipeline == "a" ? 5.0 : 0.0);
    EXPECT_EQ(row.b - row.a, row.difference);
    EXPECT_EQ(row.tolerance, 1.0);
    EXPECT_EQ(row.subject, "a, \"b\"");
  }
  const Comparison better = compare_runs(b, a);
  EXPECT_EQ(better.exit_code(), 0);
  EXPECT_EQ(better.counts.at(Verdict::better), 2);
  const Comparison within = compare_runs(a, b, {{"test_unlabelled", 5.0}});
  EXPECT_EQ(within.exit_code(), 0);
  EXPECT_EQ(within.counts.at(Verdict::within), 2);
  EXPECT_THROW(compare_runs(a, b, {{"test_unlabelled", -1.0}}), ConfigError);
  EXPECT_THAT(comparison_csv(worse), HasSubstr(",beams,lower_is_better,1,worse\n"));
}

TEST(Compare, ChangesOfAMetricWithoutDirectionAreShownAndNotGated) {
  const testing::TemporaryFolder folder;
  const Comparison c = compare_runs(run_with_skip(folder.path() / "a", 0), run_with_skip(folder.path() / "b", 16));
  EXPECT_EQ(c.counts.at(Verdict::changed), 2);  // test_lines: 5 -> 0 for each seed of pipeline a
}

TEST(Compare, ACellThatFailsNowIsWorseAndOneMissingMakesItIncomplete) {
  const testing::TemporaryFolder folder;
  const fs::path good = run_with_skip(folder.path() / "good", 0);
  const fs::path failed = run_with_skip(folder.path() / "failed", 0, "test_throw");
  const Comparison worse = compare_runs(good, failed);
  EXPECT_EQ(worse.exit_code(), 1);
  EXPECT_EQ(worse.rows.back().note, "ok -> failed");
  EXPECT_EQ(compare_runs(failed, good).counts.at(Verdict::better), 2);
  EXPECT_EQ(compare_runs(failed, failed).counts.at(Verdict::not_judged), 2);
  EXPECT_EQ(compare_runs(failed, failed).exit_code(), 0);

  const fs::path short_run = run_with_skip(folder.path() / "short", 0, "test_line", {1});
  EXPECT_EQ(compare_runs(good, short_run).exit_code(), 4);
  EXPECT_EQ(compare_runs(short_run, good).exit_code(), 4);
  fs::remove_all(cell_path(failed, {"s", "a", 2}));
  const Comparison both = compare_runs(good, failed);
  EXPECT_TRUE(both.incomplete);
  EXPECT_EQ(both.exit_code(), 5);  // neither hides the other
  EXPECT_THROW(compare_runs(good, folder.path()), ConfigError);
}

TEST(Compare, ARowThatIsGoneMakesItIncompleteAndAValueThatIsGoneIsWorse) {
  const testing::TemporaryFolder folder;
  const fs::path a = run_with_skip(folder.path() / "a", 0);
  const fs::path b = run_with_skip(folder.path() / "b", 0);
  const fs::path file = cell_path(b, {"s", "a", 1}) / "metrics.csv";
  const std::string text = read_file(file);
  const std::string lines = "test_lines,all,5,,5,,\n";
  const auto at = text.find(lines);
  ASSERT_NE(at, std::string::npos);
  write_file_atomically(file, std::string(text).erase(at, lines.size()));
  EXPECT_EQ(compare_runs(a, b).counts.at(Verdict::only_in_a), 1);
  EXPECT_EQ(compare_runs(a, b).exit_code(), 4);
  EXPECT_EQ(compare_runs(b, a).counts.at(Verdict::only_in_b), 1);
  write_file_atomically(file, std::string(text).replace(at, lines.size(), "test_lines,all,,,5,,\n"));
  EXPECT_EQ(compare_runs(a, b).counts.at(Verdict::worse), 1);
}

TEST(Compare, OfAnInfiniteValueIsNeverBetter) {
  const testing::TemporaryFolder folder;
  const fs::path a = run_with_skip(folder.path() / "a", 0);
  const fs::path b = run_with_skip(folder.path() / "b", 0);
  const std::string name = "test_unlabelled,\"a, \"\"b\"\"\",";
  const auto set_value = [&](const fs::path& run, const std::string& value) {
    const fs::path file = cell_path(run, {"s", "a", 1}) / "metrics.csv";
    std::string text = read_file(file);
    const auto at = text.find(name);
    ASSERT_NE(at, std::string::npos) << text;
    const auto from = at + name.size();
    write_file_atomically(file, text.replace(from, text.find(',', from) - from, value));
  };
  const auto verdicts = [&](const std::string& value_a, const std::string& value_b) {
    set_value(a, value_a);
    set_value(b, value_b);
    return compare_runs(a, b).counts;
  };
  EXPECT_EQ(verdicts("inf", "-inf").count(Verdict::better), 0U);
  EXPECT_EQ(verdicts("inf", "-inf").at(Verdict::changed), 1);
  EXPECT_EQ(verdicts("3", "-inf").at(Verdict::worse), 1);
  EXPECT_EQ(verdicts("-inf", "3").at(Verdict::better), 1);
  EXPECT_EQ(verdicts("inf", "inf").at(Verdict::same), 12);
}

TEST(Compare, OfTwoRunsWithTheSameSelectionIsComplete) {
  const testing::TemporaryFolder folder;
  const auto run_only = [&](const char* name, const std::string& only) {
    run_here({scenario_with("s", {extract_with("a", "test_line"), extract_with("b", "test_line")}, {1, 2})},
             {.out = folder.path() / name, .only = {only}, .argv = {"scanbench", "run", "s.yaml", "--only", only}});
    return folder.path() / name;
  };
  const fs::path one = run_only("one", "a");
  const fs::path two = run_only("two", "s/a");
  const fs::path other = run_only("other", "b");
  EXPECT_EQ(compare_runs(one, two).exit_code(), 0);
  EXPECT_EQ(compare_runs(one, two).rows.size(), 2U * 3U);
  EXPECT_EQ(compare_runs(one, other).exit_code(), 4);
  fs::remove_all(cell_path(one, {"s", "a", 2}));
  fs::remove_all(cell_path(two, {"s", "a", 2}));
  EXPECT_EQ(compare_runs(one, two).exit_code(), 4);  // requested, and missing in both
}

TEST(Compare, SaysWhenTheRecordingsDiffer) {
  const testing::TemporaryFolder folder;
  const fs::path a = run_with_skip(folder.path() / "a", 0);
  const fs::path b = folder.path() / "b";
  RunServices other = testing::services();
  other.recording = [](const Scenario&, std::uint64_t seed, int) {
    return testing::random_recording(seed + 100, 5, 16, true);
  };
  run_with({scenario_with("s", {extract_with("a", "test_line"), extract_with("b", "test_line")}, {1, 2})}, {.out = b},
           other);
  EXPECT_THAT(compare_runs(a, b).notes, ElementsAre("the recordings of s/1 differ", "the recordings of s/2 differ"));
}

}  // namespace
}  // namespace scanbench::harness
