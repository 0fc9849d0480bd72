// Values of single scans of recorded logs, and comparisons of two runs on one log.
#include "harness/results/analysis/scan_pairs.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/rng.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/results/analysis/comparison.hpp"
#include "harness/results/analysis/gates.hpp"
#include "harness/results/analysis/run_results.hpp"
#include "harness/results/analysis/scan_values.hpp"
#include "harness/results/analysis/verdict.hpp"
#include "harness/runs/execute/runner.hpp"
#include "harness/study/scenario/scenario_file.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::results {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr int kScans = 60;
constexpr int kBeams = 16;

/// Scans of a rough wall from positions one metre apart, and what somebody measured of the motions between them.
class ScanPairs : public ::testing::Test {
 protected:
  void SetUp() override {
    write_log(1);
    std::string relations;
    for (int i = 0; i + 1 < kScans; ++i)
      relations += fmt::format("EDGE2 {} {} {} {} 0 1 0 1 1 0 0\n", i, i + 1, 1.0 + shift(i), 2.0 * shift(i));
    io::write_file_atomically(folder_.path() / "relations.txt", relations);
  }

  void write_log(std::uint64_t seed) const {
    CounterRng rng(seed, RngStream::range);
    std::string log;
    for (int i = 0; i < kScans; ++i) {
      log += fmt::format("{},{},0,0", i, i);
      for (int beam = 0; beam < kBeams; ++beam) log += fmt::format(",{}", 3.0 + 0.2 * rng.uniform());
      log += "\n";
    }
    io::write_file_atomically(folder_.path() / "log.csv", log);
  }

  static double shift(int i) { return 0.01 * (i % 7); }

  /// A run of a pipeline that leaves `skip` beams of every scan without a line.
  RunResults run_with_skip(const std::string& name, int skip) const {
    io::write_file_atomically(
        folder_.path() / "mine.yaml",
        fmt::format(
            "schema: 1\nabout: a log\nrecording: {{log: log.csv, format: csv, columns: [t_s, x_m, y_m, yaw_deg, "
            "ranges], beams: {}, first_angle_deg: -60, step_deg: 8, relations: relations.txt}}\nseed: 1\n"
            "pipelines:\n  - {{name: a, extract: {{module: test_line, params: {{skip: {}}}}}, match: {{module: "
            "test_ahead}}}}\nmetrics: [siadat1997, trajectory]\n",
            kBeams, skip));
    const fs::path out = folder_.path() / name;
    EXPECT_EQ(runs::run({study::load_scenario(folder_.path() / "mine.yaml")}, {.out = out}).exit_code(), 0);
    return load_run_results(out);
  }

  static MetricChange change_of(const Comparison& comparison, const std::string& metric) {
    const auto found =
        std::ranges::find_if(comparison.changes, [&](const auto& c) { return c.metric.metric == metric; });
    return found == comparison.changes.end() ? MetricChange{} : *found;
  }
  static double value_of(const RunResults& run, const std::string& metric) {
    for (const auto& row : run.cells.at(0).rows)
      if (row.metric == metric) return row.value;
    return kNaN;
  }

  support::TemporaryFolder folder_;
};

TEST_F(ScanPairs, OfAMeanOverScansHaveItsOwnDifferenceWithAnInterval) {
  const RunResults before = run_with_skip("before", 0);
  const RunResults after = run_with_skip("after", 5);
  const MetricChange change = change_of(compare(before, after, Gates()), "d_mean");
  ASSERT_TRUE(change.scans.has_value()) << change.by_value;
  EXPECT_EQ(change.scans->count, static_cast<std::size_t>(kScans));
  EXPECT_GE(change.scans->block, 1U);
  EXPECT_NEAR(change.difference.mean, value_of(after, "d_mean") - value_of(before, "d_mean"), 1e-12);
  EXPECT_LT(change.difference.low, change.difference.mean);
  EXPECT_GT(change.difference.high, change.difference.mean);
  EXPECT_GE(change.q, 0.0);
  EXPECT_THAT(change_sentence(change), HasSubstr(fmt::format("over {} scans in blocks of ", kScans)));
}

TEST_F(ScanPairs, OfAnUntouchedRunAreEqualToTheBit) {
  const RunResults before = run_with_skip("before", 3);
  const RunResults after = run_with_skip("after", 3);
  const MetricChange change = change_of(compare(before, after, Gates()), "d_mean");
  EXPECT_EQ(change.finding, Finding::same);
  EXPECT_EQ(change.difference.mean, 0.0);
}

TEST_F(ScanPairs, AreNotTakenOfOtherScansNorOfAValueThatIsNoMean) {
  const RunResults before = run_with_skip("before", 0);
  const RunResults after = run_with_skip("after", 5);
  RunResults baseline = before;
  baseline.folder.clear();
  baseline.name = "baseline 0001";
  const MetricChange alone = change_of(compare(baseline, after, Gates()), "d_mean");
  EXPECT_FALSE(alone.scans.has_value());
  EXPECT_EQ(alone.by_value, "baseline 0001 keeps no single scans");
  EXPECT_EQ(alone.difference.low, alone.difference.high);
  EXPECT_THAT(change_sentence(alone), HasSubstr("without an interval: baseline 0001 keeps no single scans"));

  write_log(2);
  const RunResults elsewhere = run_with_skip("elsewhere", 5);
  const Comparison other = compare(before, elsewhere, Gates());
  EXPECT_EQ(change_of(other, "d_mean").by_value, "the two recordings are not the same");
  EXPECT_THAT(other.differing, ::testing::Contains(HasSubstr("scans of mine/1")));
}

TEST_F(ScanPairs, OfRelationsAreTheirDeviations) {
  const RunResults run = run_with_skip("before", 0);
  ScanValueReader reader(run.folder);
  const runs::CellKey key{"mine", "a", 1};
  EXPECT_TRUE(reader.is_log(key));
  const auto values = reader.of(key, "relations_position");
  ASSERT_TRUE(values.has_value());
  EXPECT_STREQ(values->of, "relations");
  ASSERT_EQ(values->values.size(), static_cast<std::size_t>(kScans - 1));
  // The matcher moves one metre ahead from scan to scan.
  for (int i = 0; i + 1 < kScans; ++i)
    EXPECT_NEAR(values->values[static_cast<std::size_t>(i)], std::hypot(shift(i), 2.0 * shift(i)), 1e-9) << i;
  EXPECT_EQ(reader.of(key, "relations_position_square")->mean, ScanMean::mean);
  EXPECT_FALSE(reader.of(key, "s_max").has_value() && reader.of(key, "polygon_bytes")->values.empty());
  EXPECT_FALSE(reader.of(key, "t_total").has_value());
  EXPECT_FALSE(reader.of(key, "no_such_metric").has_value());
}

TEST_F(ScanPairs, OfNeighbouringScansAreTheErrorsOfTheirMotion) {
  std::string log;
  for (int i = 0; i < kScans; ++i) {
    log += fmt::format("FLASER {}", kBeams);
    for (int beam = 0; beam < kBeams; ++beam) log += fmt::format(" {:.2f}", 3.0 + 0.01 * ((beam * i) % 7));
    log += fmt::format(" {:.3f} 0 0 {:.3f} 0 0 {:.3f} host {:.3f}\n", i + shift(i), 1.0 * i, 1.0 * i, 1.0 * i);
  }
  io::write_file_atomically(folder_.path() / "carmen.log", log);
  io::write_file_atomically(folder_.path() / "mine.yaml",
                            "schema: 1\nabout: a log\nrecording: {log: carmen.log, format: carmen, no_return_m: 81, "
                            "first_angle_deg: -60, step_deg: 8, poses: odometry, compare_poses: reference}\nseed: 1\n"
                            "pipelines:\n  - {name: a, extract: {module: test_line}, match: {module: test_ahead}}\n"
                            "metrics: [trajectory]\n");
  const fs::path out = folder_.path() / "run";
  ASSERT_EQ(runs::run({study::load_scenario(folder_.path() / "mine.yaml")}, {.out = out}).exit_code(), 0);
  ScanValueReader reader(out);
  const auto values = reader.of({"mine", "a", 1}, "rpe_position");
  ASSERT_TRUE(values.has_value());
  EXPECT_STREQ(values->of, "pairs of scans");
  EXPECT_EQ(values->mean, ScanMean::root_mean_square);
  ASSERT_EQ(values->values.size(), static_cast<std::size_t>(kScans - 1));
  // The matcher moves one metre ahead; the reference moves by 1 + shift(i + 1) - shift(i).
  for (int i = 0; i + 1 < kScans; ++i)
    EXPECT_NEAR(values->values[static_cast<std::size_t>(i)], std::fabs(shift(i + 1) - shift(i)), 1e-9) << i;
  EXPECT_FALSE(reader.of({"mine", "a", 1}, "ate_position_max").has_value());
}

}  // namespace
}  // namespace scanbench::results
