// Paired comparisons of pipelines and the list of seeds that were not placed.
#include "harness/results/tables/paired_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/runs.hpp"

namespace scanbench::results {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

struct Made {
  study::Scenario scenario;
  ComparableRows results;
  std::vector<CellLine> cells;

  void add(const std::string& pipeline, std::uint64_t seed, const std::string& metric, double value) {
    results.rows.push_back({"s", pipeline, seed, metric, "all", value, "", 1});
  }
};

Made two_pipelines(std::size_t seeds) {
  Made made;
  made.scenario.name = "s";
  made.results.pipelines = {"a", "b"};
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    made.results.seeds.push_back(seed);
    made.scenario.seeds.push_back(seed);
  }
  return made;
}

TEST(PairedTables, DifferAndDivideSeedBySeed) {
  Made made = two_pipelines(4);
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const double a = 0.1 * static_cast<double>(seed);
    made.add("a", seed, "position_error", a);
    made.add("b", seed, "position_error", seed == 4 ? 2 * a : a / 2);  // ratios 1/2, 1/2, 1/2, 2: geometric mean 2^-1/2
  }
  const auto tables = paired_tables(made.scenario, made.results, {});
  ASSERT_THAT(tables, SizeIs(1));
  ASSERT_THAT(tables[0].rows, SizeIs(1));
  const auto& row = tables[0].rows[0];
  EXPECT_EQ(row.heads, (std::vector<std::string>{"b", "a"}));
  EXPECT_THAT(row.cells[0].text, HasSubstr("2.5")) << "cm: (-5 -10 -15 +40) / 4";
  EXPECT_THAT(row.cells[1].text, HasSubstr("0.707 ("));
  EXPECT_EQ(row.cells[2].text, "3 of 4 seeds");
}

TEST(PairedTables, MarkNothing) {
  Made made = two_pipelines(5);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const double a = 0.1 + 0.01 * static_cast<double>(seed);
    made.add("a", seed, "relations_position", a);
    made.add("b", seed, "relations_position", 0.5 * a);
  }
  const auto tables = paired_tables(made.scenario, made.results, {});
  ASSERT_THAT(tables, SizeIs(1));
  for (const auto& cell : tables[0].rows.at(0).cells) EXPECT_FALSE(cell.best) << "a difference is not the best value";
  EXPECT_EQ(tables[0].rows.at(0).cells[1].text, "0.500 (0.500 to 0.500)");
}

TEST(PairedTables, NameTheSeedsThatWereNotPlacedAndWhatWasSaid) {
  Made made = two_pipelines(3);
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    for (const char* pipeline : {"a", "b"}) {
      const bool placed = pipeline[0] == 'a' || seed != 2;
      made.add(pipeline, seed, "all_placed", placed ? 1.0 : 0.0);
      made.add(pipeline, seed, "position_error_max", placed ? 0.01 : 0.42);
      made.add(pipeline, seed, "heading_error_max", placed ? 0.1 : 7.5);
    }
  made.cells.push_back({"s", "b", 2, "ok", "scan 4 can slide", 0.0, 0.0});
  const auto tables = paired_tables(made.scenario, made.results, made.cells);
  ASSERT_THAT(tables, SizeIs(1));
  ASSERT_THAT(tables[0].rows, SizeIs(2));
  EXPECT_EQ(tables[0].rows[0].cells[0].text, "3 of 3");
  EXPECT_THAT(tables[0].rows[0].cells[1].text, IsEmpty());
  EXPECT_EQ(tables[0].rows[1].cells[0].text, "2 of 3");
  EXPECT_EQ(tables[0].rows[1].cells[1].text, "2 (0.42 m, 7.5 deg)");
  EXPECT_EQ(tables[0].rows[1].cells[2].text, "scan 4 can slide");
}

TEST(PairedTables, NeedTwoSeedsAndTwoPipelines) {
  Made made = two_pipelines(1);
  for (const char* pipeline : {"a", "b"}) made.add(pipeline, 1, "position_error", 0.1);
  EXPECT_THAT(paired_tables(made.scenario, made.results, {}), IsEmpty());
}

}  // namespace
}  // namespace scanbench::results
