// The ranking of aligners over scenarios and their basins of convergence.
#include "harness/report/aligner_ranking.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/runs.hpp"

namespace scanbench::harness {
namespace {

using ::testing::ElementsAre;
using testing::extract_with;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

struct Made {
  std::vector<Scenario> scenarios;
  std::vector<SummaryRow> rows;

  void scenario(const std::string& name, double start_m) {
    Scenario s;
    s.name = name;
    s.seeds = {1, 2};
    for (const char* pipeline : {"a", "b"}) s.pipelines.push_back(extract_with(pipeline, "test_line"));
    scenarios.push_back(s);
    for (const char* pipeline : {"a", "b"})
      for (const std::uint64_t seed : s.seeds) add(name, pipeline, seed, "start_position_error", start_m);
  }
  void add(const std::string& scenario, const std::string& pipeline, std::uint64_t seed, const std::string& metric,
           double value) {
    rows.push_back({scenario, pipeline, seed, metric, "all", value, "", 1});
  }
  void result(const std::string& scenario, const std::string& pipeline, std::uint64_t seed, double placed) {
    add(scenario, pipeline, seed, "placed", placed);
    add(scenario, pipeline, seed, "all_placed", placed == 1.0 ? 1.0 : 0.0);
    add(scenario, pipeline, seed, "error_ratio", placed == 1.0 ? 0.1 : 1.0);
  }
};

Made near_and_far() {
  Made made;
  made.scenario("far", 0.5);
  made.scenario("near", 0.1);
  for (const std::uint64_t seed : {1, 2}) {
    made.result("near", "a", seed, 1.0);
    made.result("near", "b", seed, 1.0);
    made.result("far", "a", seed, 0.5);
    made.result("far", "b", seed, seed == 1 ? 1.0 : 0.9);
  }
  return made;
}

TEST(AlignerRanking, PutsTheAlignerThatPlacesMostFirst) {
  const Made made = near_and_far();
  const auto tables = aligner_ranking(made.scenarios, made.rows);
  ASSERT_THAT(tables, SizeIs(2));
  ASSERT_THAT(tables[0].rows, SizeIs(2));
  EXPECT_THAT(tables[0].rows[0].heads, ElementsAre("1", "b"));
  EXPECT_THAT(tables[0].rows[0].cells[0].text, HasSubstr("97.5")) << "(1 + 1 + 1 + 0.9) / 4";
  EXPECT_TRUE(tables[0].rows[0].cells[0].best);
  EXPECT_THAT(tables[0].rows[0].cells[1].text, HasSubstr("22.5"));
  EXPECT_THAT(tables[0].rows[1].cells[0].text, HasSubstr("75.0"));
  EXPECT_THAT(tables[0].rows[1].cells[3].text, HasSubstr("0.316")) << "the root of 0.1 x 1";
}

TEST(AlignerRanking, OrdersScenariosByTheErrorOfTheGivenPoses) {
  const Made made = near_and_far();
  const auto tables = aligner_ranking(made.scenarios, made.rows);
  ASSERT_THAT(tables, SizeIs(2));
  const Table& basin = tables[1];
  ASSERT_THAT(basin.rows, SizeIs(2));
  EXPECT_THAT(basin.rows[0].heads, ElementsAre("near", "10.0"));
  EXPECT_THAT(basin.rows[1].heads, ElementsAre("far", "50.0"));
  EXPECT_EQ(basin.columns[0].head, "b");
  EXPECT_EQ(basin.rows[1].cells[0].text, "50");
  EXPECT_EQ(basin.rows[1].cells[1].text, "0");
}

TEST(AlignerRanking, CountsOnlySeedsThatAllFinished) {
  Made made = near_and_far();
  std::erase_if(made.rows, [](const SummaryRow& r) { return r.scenario == "far" && r.pipeline == "a" && r.seed == 2; });
  const auto tables = aligner_ranking(made.scenarios, made.rows);
  ASSERT_THAT(tables, SizeIs(2));
  EXPECT_EQ(tables[0].rows[0].cells[0].text, "100.0") << "seed 1 alone";
}

TEST(AlignerRanking, NeedsTwoScenariosThatPlaceScans) {
  Made made = near_and_far();
  made.scenarios.pop_back();
  EXPECT_THAT(aligner_ranking(made.scenarios, made.rows), IsEmpty());
  EXPECT_THAT(aligner_ranking({}, {}), IsEmpty());
}

}  // namespace
}  // namespace scanbench::harness
