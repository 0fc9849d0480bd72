// Scores of a run: choice of families, repetition, and interruption.
#include "harness/runs/execute/score.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/registry.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/runs/execute/pipeline.hpp"
#include "harness/runs/execute/run_options.hpp"
#include "harness/runs/store/cell_files.hpp"
#include "harness/runs/store/summary.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::runs {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<study::ModuleChoice> kFamilies{{"metrics", "test_needs_map", {}}, {"metrics", "test_metrics", {}}};

TEST(Score, LeavesOutFamiliesThatDoNotApply) {
  const study::PipelineSpec extract = fixtures::extract_with("p", "test_line");
  study::PipelineSpec merge = extract;
  merge.slots.push_back({"merge", "test_merge", {}});
  const Recording with_truth = fixtures::random_recording(1, 5, 16, true);
  const Recording log = fixtures::random_recording(1, 5, 16, false);
  const auto names = [](const std::vector<metrics::MetricRow>& rows) {
    std::string text;
    for (const auto& row : rows) text += row.metric + " ";
    return text;
  };
  const auto score = [&](const study::PipelineSpec& pipeline, const Recording& recording) {
    return names(evaluate_metrics(kFamilies, recording, run_pipeline(pipeline, recording.observed).result).rows);
  };
  EXPECT_EQ(score(extract, with_truth), "test_unlabelled test_lines test_undefined ");
  EXPECT_EQ(score(merge, with_truth), "test_map test_unlabelled test_lines test_undefined ");
  EXPECT_EQ(score(merge, log), "test_map ");
  EXPECT_EQ(score(extract, log), "");
  EXPECT_THROW(evaluate_metrics({{"metrics", "no such family", {}}}, log, {}), ConfigError);
}

/// Refuses every input.
class RefusingMetrics final : public metrics::MetricFamily {
 public:
  using Params = NoParams;
  explicit RefusingMetrics(const Params&) {}
  std::vector<metrics::MetricDescription> describe() const override { return {}; }
  bool applies(const metrics::MetricInput&) const override { return true; }
  std::vector<metrics::MetricRow> evaluate(const metrics::MetricInput&) const override {
    throw ConfigError("too large");
  }
};
const bool kRefusesRegistered = Registry<metrics::MetricFamily>::add<RefusingMetrics>(
    {.name = "test_refuses", .summary = "of the tests", .reference = "none"});

TEST(Score, AMetricThatRefusesLosesItsOwnRowsOnly) {
  ASSERT_TRUE(kRefusesRegistered);
  const support::TemporaryFolder folder;
  const fs::path run = folder.path() / "run";
  study::Scenario scenario = fixtures::scenario_with("s", {fixtures::extract_with("p", "test_line")});
  scenario.metrics = {{"metrics", "test_refuses", {}}, {"metrics", "test_metrics", {}}};
  const RunResult result = fixtures::run_here({scenario}, {.out = run});
  ASSERT_EQ(result.cells.size(), 1u);
  EXPECT_EQ(result.cells[0].record.outcome.status, CellStatus::ok);
  EXPECT_EQ(result.cells[0].record.outcome.message, "metrics: test_refuses: too large");
  EXPECT_THAT(io::read_file(run / "summary.csv"), HasSubstr("s,p,1,test_lines,all,5,,5\n"));
  EXPECT_TRUE(fs::exists(cell_path(run, {"s", "p", 1}) / "lines.csv"));

  scenario.metrics = {{"metrics", "test_metrics", {}}};
  score_run(run, {scenario});
  EXPECT_EQ(load_status(cell_path(run, {"s", "p", 1})).outcome.message, "") << "nothing refuses any more";
}

TEST(Score, AMessageKeepsTheOutcomesOfThePipeline) {
  const std::string outcomes = "match: 1 no_match; map: 2 degenerate";
  EXPECT_EQ(message_with(outcomes, ""), outcomes);
  EXPECT_EQ(message_with(outcomes, "metrics: a: b"), outcomes + "; metrics: a: b");
  EXPECT_EQ(message_with(outcomes + "; metrics: a: b", "metrics: c: d"), outcomes + "; metrics: c: d");
  EXPECT_EQ(message_with("metrics: a: b", ""), "");
}

TEST(Score, OfARunReadsFilesOnlyAndMayBeRepeatedWithOtherMetrics) {
  const support::TemporaryFolder folder;
  const fs::path run = folder.path() / "run";
  study::Scenario scenario = fixtures::scenario_with(
      "s", {fixtures::extract_with("good", "test_line"), fixtures::extract_with("bad", "test_throw")}, {1, 2});
  fixtures::run_here({scenario}, {.out = run});
  const auto before = fixtures::artefacts(run);
  EXPECT_EQ(score_run(run, {scenario}), 2u);
  EXPECT_EQ(fixtures::artefacts(run), before);

  const auto stands = [&] {
    const auto cells = fixtures::run_here({scenario}, {.out = run, .resume = true}).cells;
    return std::ranges::count_if(cells, [](const CellResult& cell) { return cell.reused; });
  };
  EXPECT_EQ(stands(), 2);
  const auto metrics = scenario.metrics;
  scenario.metrics = {};
  score_run(run, {scenario});
  EXPECT_EQ(io::read_file(run / "summary.csv"), summary_header());
  scenario.metrics = metrics;
  EXPECT_EQ(stands(), 0);  // cells without metrics do not belong to the scenario
  scenario.metrics = {{"metrics", "test_metrics", {}}};
  // The labels decide, not what the run once computed.
  const fs::path cell = cell_path(run, {"s", "good", 1});
  io::write_file_atomically(cell / "lines.csv", io::read_file(cell / "lines.csv") + "4,1,0,0,1,1,0,0,0,1,2,0\n");
  score_run(run, {scenario});
  EXPECT_THAT(io::read_file(run / "summary.csv"), HasSubstr("s,good,1,test_lines,all,6,,6\n"));
  EXPECT_THAT(io::read_file(run / "summary.csv"), HasSubstr("s,good,2,test_lines,all,5,,5\n"));
  EXPECT_THAT(io::read_file(run / "summary.csv"), Not(HasSubstr("bad")));
  EXPECT_THROW(score_run(run, {}), ConfigError);
}

TEST(Score, RemovesTablesOfAnEarlierScoreAndNothingElse) {
  const support::TemporaryFolder folder;
  const fs::path run = folder.path() / "run";
  study::Scenario scenario = fixtures::scenario_with("s", {fixtures::extract_with("good", "test_line")});
  scenario.metrics = {{"metrics", "test_metrics", {{"table", true}}}};
  fixtures::run_here({scenario}, {.out = run});
  const fs::path cell = cell_path(run, {"s", "good", 1});
  const std::string table = io::read_file(cell / "test_table.csv");
  EXPECT_EQ(table.substr(0, 6), "lines\n");
  io::write_file_atomically(cell / "mine.csv", "of the user\n");

  scenario.metrics = {{"metrics", "test_metrics", {}}};
  score_run(run, {scenario});
  EXPECT_FALSE(fs::exists(cell / "test_table.csv"));
  EXPECT_TRUE(fs::exists(cell / "mine.csv"));

  scenario.metrics = {{"metrics", "test_metrics", {{"table", true}}}};
  score_run(run, {scenario});
  EXPECT_EQ(io::read_file(cell / "test_table.csv"), table);
  scenario.metrics = {};
  score_run(run, {scenario});
  EXPECT_FALSE(fs::exists(cell / "test_table.csv"));
}

TEST(Score, ThatIsStoppedLeavesTheRunAsItWas) {
  const support::TemporaryFolder folder;
  const fs::path run = folder.path() / "run";
  study::Scenario scenario = fixtures::scenario_with("s", {fixtures::extract_with("good", "test_line")}, {1, 2, 3});
  fixtures::run_here({scenario}, {.out = run});
  const auto before = fixtures::artefacts(run);
  scenario.metrics = {};  // other rows than those in the run
  struct Stopped {};
  std::vector<std::string> told;
  const auto stop = [&](double share, const std::string& cell) {
    EXPECT_DOUBLE_EQ(share, static_cast<double>(told.size()) / 3);
    told.push_back(cell);
    if (told.size() == 3) throw Stopped{};
  };
  EXPECT_THROW(score_run(run, {scenario}, stop), Stopped);
  EXPECT_EQ(told, (std::vector<std::string>{"s/good/1", "s/good/2", "s/good/3"}));
  EXPECT_EQ(fixtures::artefacts(run), before);
}

}  // namespace
}  // namespace scanbench::runs
