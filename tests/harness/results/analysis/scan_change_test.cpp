// The scan that shows a change, against the tables that the runs wrote.
#include "harness/results/analysis/scan_change.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/io/files/atomic_file.hpp"
#include "harness/results/analysis/gates.hpp"
#include "harness/runs/execute/runner.hpp"
#include "harness/runs/store/run_store.hpp"
#include "harness/study/scenario/scenario_file.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::results {
namespace {

namespace fs = std::filesystem;

const runs::CellKey kCell{"corner", "a", 1};

/// Runs of a robot that drives along one wall towards another. A line through all returns is right where a single wall
/// is in view, or where the returns of the first one are left out.
class ScanChanges : public ::testing::Test {
 protected:
  fs::path run_with_skip(int skip, int scans) const {
    io::write_file_atomically(
        folder_.path() / "corner.yaml",
        fmt::format("schema: 1\nabout: a corner\nworld: {{segments: [[a, 0, 0, 10, 0], [b, 10, 0, 10, 3]]}}\n"
                    "sensor: {{preset: sick_lms200}}\ntrajectory: {{kind: waypoints, points_m: {{A: [1, 1.5], B: [9, "
                    "1.5]}}, scans: {}}}\nseed: 1\npipelines:\n  - {{name: a, extract: {{module: test_line, params: "
                    "{{skip: {}}}}}}}\nmetrics: [segments]\n",
                    scans, skip));
    const fs::path out = folder_.path() / fmt::format("skip_{}_of_{}", skip, scans);
    EXPECT_EQ(runs::run({study::load_scenario(folder_.path() / "corner.yaml")}, {.out = out}).exit_code(), 0);
    return out;
  }

  /// The column f1 of scans.csv, which the run wrote itself.
  static std::vector<double> f1_of(const fs::path& run) {
    const io::CsvTable table = runs::RunStore(run).files(kCell).table("scans.csv", {"frame", "f1"});
    std::vector<double> values;
    for (std::size_t row = 0; row < table.rows(); ++row) values.push_back(table.number(row, "f1"));
    return values;
  }

  static metrics::MetricDescription metric(const std::string& name) { return metric_descriptions().at(name); }

  support::TemporaryFolder folder_;
};

TEST_F(ScanChanges, ValuesOfSingleScansAreThoseOfTheTable) {
  for (const int scans : {5, 20}) {
    const fs::path run = run_with_skip(100, scans);
    ScanValueReader reader(run);
    const auto values = reader.by_scan(kCell, "f1");
    ASSERT_TRUE(values) << scans;
    const std::vector<double> table = f1_of(run);
    ASSERT_EQ(values->size(), table.size());
    for (std::size_t f = 0; f < table.size(); ++f)
      EXPECT_TRUE((*values)[f] == table[f] || (std::isnan((*values)[f]) && std::isnan(table[f]))) << f;
    EXPECT_FALSE(reader.by_scan(kCell, "covered_5cm"));  // of a map, which this run does not have
  }
}

TEST_F(ScanChanges, IsTheScanThatBecameWorseByMost) {
  const fs::path before = run_with_skip(100, 20), after = run_with_skip(0, 20);
  const std::vector<double> earlier = f1_of(before), later = f1_of(after);
  std::size_t expected = 0;
  for (std::size_t f = 0; f < earlier.size(); ++f)
    if (earlier[f] - later[f] > earlier[expected] - later[expected]) expected = f;
  ASSERT_GT(earlier[expected] - later[expected], 0.0) << "the runs do not differ";
  ScanValueReader reader_before(before), reader_after(after);
  const auto change = most_changed_scan(reader_before, reader_after, kCell, metric("f1"));
  ASSERT_TRUE(change);
  EXPECT_EQ(change->frame, expected);
  EXPECT_EQ(change->before, earlier[expected]);
  EXPECT_EQ(change->after, later[expected]);
  EXPECT_EQ(change->scans, 20U);
  EXPECT_FALSE(change->substitute);
}

TEST_F(ScanChanges, OfAMetricWithoutValuesOfSingleScansIsThatOfTheHeadline) {
  const fs::path before = run_with_skip(100, 20), after = run_with_skip(0, 20);
  ScanValueReader reader_before(before), reader_after(after);
  const auto of_f1 = most_changed_scan(reader_before, reader_after, kCell, metric("f1"));
  const auto of_map = most_changed_scan(reader_before, reader_after, kCell, metric("covered_5cm"));
  ASSERT_TRUE(of_f1 && of_map);
  EXPECT_TRUE(of_map->substitute);
  EXPECT_EQ(of_map->metric.metric, "f1");
  EXPECT_EQ(of_map->frame, of_f1->frame);
}

TEST_F(ScanChanges, AreNoneBetweenEqualRuns) {
  const fs::path run = run_with_skip(0, 20);
  ScanValueReader before(run), after(run);
  EXPECT_FALSE(most_changed_scan(before, after, kCell, metric("f1")));
}

}  // namespace
}  // namespace scanbench::results
