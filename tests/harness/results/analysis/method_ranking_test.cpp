// Rankings of pipelines whose values are made up.
#include "harness/results/analysis/method_ranking.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/special_values.hpp"
#include "tests/harness/results/analysis/made_up_runs.hpp"

namespace scanbench::results {
namespace {

using fixtures::made_up_run;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// b is 0.1 better than a on every seed, c is equal to a.
RunResults three_pipelines(std::size_t seeds) {
  return made_up_run({"a", "b", "c"}, {"f1"}, seeds, [](const auto& pipeline, const auto&, std::uint64_t seed) {
    return 0.5 + 0.01 * static_cast<double>(seed) + (pipeline == "b" ? 0.1 : 0.0);
  });
}

std::map<runs::CellKey, double> seconds_of(const RunResults& run, const std::map<std::string, double>& of_pipeline) {
  std::map<runs::CellKey, double> seconds;
  for (const auto& cell : run.cells) seconds[cell.key] = of_pipeline.at(cell.key.pipeline);
  return seconds;
}

std::vector<std::string> names(const MethodRanking& ranking) {
  std::vector<std::string> all;
  for (const auto& method : ranking.methods) all.push_back(method.pipeline);
  return all;
}

TEST(MethodRanking, GivesTheProbabilityToBeatTheNextWithClopperAndPearsonsInterval) {
  const auto rankings = rank_methods(three_pipelines(6).cells, {});
  ASSERT_EQ(rankings.size(), 1U);
  EXPECT_THAT(names(rankings[0]), ElementsAre("b", "a", "c"));
  const auto& methods = rankings[0].methods;
  EXPECT_EQ(rankings[0].quality.metric, "f1");
  EXPECT_NEAR(methods[0].quality.mean, 0.635, 1e-12);
  EXPECT_EQ(methods[0].beats_next.mean, 1.0);
  EXPECT_NEAR(methods[0].beats_next.low, std::pow(0.025, 1.0 / 6), 1e-9);  // all of n: the n-th root of the tail
  EXPECT_EQ(methods[0].beats_next.high, 1.0);
  EXPECT_EQ(methods[1].beats_next.mean, 0.5);  // ties
  EXPECT_TRUE(std::isnan(methods[2].beats_next.mean));
}

TEST(MethodRanking, FrontHasThePipelinesThatNoOtherBeatsInBoth) {
  const RunResults run = three_pipelines(4);
  const auto methods = rank_methods(run.cells, seconds_of(run, {{"a", 2.0}, {"b", 3.0}, {"c", 1.0}})).at(0).methods;
  EXPECT_TRUE(methods[0].on_front);   // b: the best
  EXPECT_FALSE(methods[1].on_front);  // a: as good as c, and slower
  EXPECT_TRUE(methods[2].on_front);   // c: the fastest
  EXPECT_NEAR(methods[0].seconds, 3.0, 1e-12);
}

TEST(MethodRanking, PutsPipelinesWithMissingValuesLastAndClaimsNothingOfThem) {
  RunResults run = three_pipelines(4);
  for (auto& cell : run.cells)
    if (cell.key.pipeline == "b" && cell.key.seed > 2) {
      cell.status = "crashed";
      cell.rows.clear();
    }
  const auto methods = rank_methods(run.cells, seconds_of(run, {{"a", 2.0}, {"b", 0.1}, {"c", 1.0}})).at(0).methods;
  EXPECT_EQ(methods.back().pipeline, "b");
  EXPECT_FALSE(methods.back().complete());
  EXPECT_EQ(methods.back().defined, 2U);
  EXPECT_FALSE(methods.back().on_front);
  EXPECT_TRUE(std::isnan(methods[1].beats_next.mean));  // beside the incomplete one
}

TEST(MethodRanking, RanksScenariosTogetherOnlyIfTheyHaveTheSamePipelines) {
  RunResults run = three_pipelines(3);
  for (const char* name : {"hall", "cave"})
    for (auto cell : three_pipelines(3).cells) {
      cell.key.scenario = name;
      if (cell.key.scenario == "cave" && cell.key.pipeline == "c") continue;
      run.cells.push_back(cell);
    }
  const auto rankings = rank_methods(run.cells, {});
  ASSERT_EQ(rankings.size(), 2U);
  EXPECT_THAT(rankings[0].scenarios, ElementsAre("room", "hall"));
  EXPECT_THAT(rankings[1].scenarios, ElementsAre("cave"));
  EXPECT_EQ(rankings[0].methods[0].cells, 6U);
  EXPECT_EQ(rankings[0].methods[0].beats_next.count, 3);  // seeds are the trials, not cells
}

TEST(MethodRanking, OfErrorsPutsTheSmallestFirst) {
  const RunResults run =
      made_up_run({"a", "b"}, {"position_error"}, 3,
                  [](const auto& pipeline, const auto&, std::uint64_t) { return pipeline == "a" ? 0.2 : 0.1; });
  EXPECT_THAT(names(rank_methods(run.cells, {}).at(0)), ElementsAre("b", "a"));
}

TEST(MethodRanking, IsEmptyWithoutAMetricOfTheListOrASecondPipeline) {
  const auto ones = [](const auto&, const auto&, std::uint64_t) { return 1.0; };
  EXPECT_THAT(rank_methods(made_up_run({"a", "b"}, {"n_true"}, 3, ones).cells, {}), IsEmpty());
  EXPECT_THAT(rank_methods(made_up_run({"a"}, {"f1"}, 3, ones).cells, {}), IsEmpty());
  // No number of lines is better than another, and small distances of points from lines do not make an extractor good.
  EXPECT_THAT(rank_methods(made_up_run({"a", "b"}, {"s_mean", "d_mean"}, 3, ones).cells, {}), IsEmpty());
}

}  // namespace
}  // namespace scanbench::results
