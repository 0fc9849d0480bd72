// What a benchmark finds, on values with known leaders, and how its page begins.
#include "harness/results/analysis/benchmark_finding.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "harness/results/analysis/shared_best.hpp"
#include "harness/results/document/html_page.hpp"
#include "harness/runs/store/summary.hpp"
#include "tests/harness/results/analysis/benchmark_scenes.hpp"

namespace scanbench::results {
namespace {

using ::testing::HasSubstr;

/// F1 of one pipeline at x and y: a mean each, and a deviation per seed.
void add_levels(std::vector<runs::SummaryRow>& rows, const std::string& pipeline, double x, double y,
                const std::vector<double>& deviations) {
  for (std::size_t k = 0; k < deviations.size(); ++k) {
    rows.push_back({"x", pipeline, k + 1, "f1", "all", x + deviations[k], "", 10});
    rows.push_back({"y", pipeline, k + 1, "f1", "all", y + deviations[k], "", 10});
  }
}

BenchmarkFinding finding_of(const std::vector<runs::SummaryRow>& rows, const study::BenchmarkSpec& spec) {
  return find_leaders(two_scenarios(), rows, spec, rank_pipelines(two_scenarios(), rows, spec));
}

TEST(BenchmarkFinding, LeadersAreThoseThatTheSeedsDoNotSeparate) {
  std::vector<runs::SummaryRow> rows;  // a - b: 0.03, 0, 0: not behind on each seed; a - c: 0.21, 0.2, 0.2
  add_levels(rows, "a", 0.80, 0.80, {0.02, 0.00, -0.02});
  add_levels(rows, "b", 0.80, 0.80, {-0.01, 0.00, -0.02});
  add_levels(rows, "c", 0.60, 0.60, {0.01, 0.00, -0.02});
  EXPECT_THAT(finding_of(rows, spec_with_levels()).leaders, ::testing::ElementsAre("a", "b"));
  std::erase_if(rows, [](const runs::SummaryRow& row) { return row.seed == 3; });
  EXPECT_TRUE(finding_of(rows, spec_with_levels()).leaders.empty()) << "two seeds separate nothing";
}

TEST(BenchmarkFinding, NamesTheFactorThatChangesTheLeader) {
  std::vector<runs::SummaryRow> rows;  // by day a leads by 0.1, by night b does
  add_levels(rows, "a", 0.90, 0.70, {0.001, 0.000, -0.001});
  add_levels(rows, "b", 0.80, 0.80, {0.000, 0.002, -0.001});
  add_levels(rows, "c", 0.10, 0.30, {0.001, 0.000, 0.001});
  const BenchmarkFinding finding = finding_of(rows, spec_with_levels());
  EXPECT_EQ(finding.factor, "light");  // `place` has one level
  ASSERT_EQ(finding.levels.size(), 2U);
  EXPECT_EQ(finding.levels[0].leaders.size(), 1U);
  EXPECT_NE(finding.levels[0].leaders, finding.levels[1].leaders);
  ReportInput input;
  input.scenarios = two_scenarios();
  input.rows = rows;
  const std::string page = to_html(page_of(input, spec_with_levels()));
  EXPECT_THAT(page, HasSubstr("do not separate them.</p>"));
  EXPECT_THAT(page, HasSubstr("<p>Which is best depends most on the light. day: a with 90.00 % ("));
  EXPECT_THAT(page, HasSubstr("; night: b with 80.03 % ("));
}

TEST(BenchmarkFinding, AFactorThatOnlyWidensALeadChangesNothing) {
  std::vector<runs::SummaryRow> rows;
  add_levels(rows, "a", 0.90, 0.80, {0.001, 0.000, -0.001});
  add_levels(rows, "b", 0.85, 0.30, {0.000, 0.002, -0.001});
  add_levels(rows, "c", 0.10, 0.20, {0.001, 0.000, 0.001});
  const BenchmarkFinding finding = finding_of(rows, spec_with_levels());
  EXPECT_THAT(finding.leaders, ::testing::ElementsAre("a"));
  EXPECT_EQ(finding.factor, "");
  ReportInput input;
  input.scenarios = two_scenarios();
  input.rows = rows;
  const std::string page = to_html(page_of(input, spec_with_levels()));
  EXPECT_THAT(page, HasSubstr("a has the best F1 of 3 extractors, 85.00 %, and is ahead on each of 3 seeds; b is next "
                              "with 57.53 %.</p>"));
  EXPECT_THAT(page, HasSubstr("<p>No factor of the suite changes which is best.</p>"));
}

TEST(SharedBest, FromSixSeedsOnTheIntervalDecides) {
  const metrics::MetricDescription f1{"f1", "F1", "", metrics::Direction::higher_is_better, 0.0, ""};
  // Behind by 0.1 but for one seed, ahead by 0.01 there. Of six, Student's interval ends at 0.082 - 2.571 * 0.018 > 0.
  EXPECT_THAT(shared_best({std::vector(6, 0.9), {0.8, 0.8, 0.8, 0.8, 0.8, 0.91}}, f1), ::testing::ElementsAre(0));
  EXPECT_THAT(shared_best({std::vector(5, 0.9), {0.8, 0.8, 0.8, 0.8, 0.91}}, f1), ::testing::ElementsAre(0, 1));
}

}  // namespace
}  // namespace scanbench::results
