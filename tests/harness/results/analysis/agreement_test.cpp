// Orderings, best methods and correlations of small tables that were counted by hand.
#include "harness/results/analysis/agreement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "harness/io/files/atomic_file.hpp"
#include "harness/results/analysis/agreement_files.hpp"
#include "harness/results/tables/agreement_tables.hpp"
#include "harness/results/tables/paper_tables.hpp"
#include "harness/results/tables/scenario_tables.hpp"
#include "harness/runs/store/summary.hpp"
#include "harness/study/scenario/published.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::results {
namespace {

using metrics::Direction;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const double kNone = std::nan("");

/// One metric of three methods on lines "1", "2", ...: what is printed, and ours for each seed.
ComparedColumn column_of(const std::vector<std::vector<double>>& paper,
                         const std::vector<std::vector<std::vector<double>>>& ours,
                         Direction direction = Direction::lower_is_better) {
  ComparedColumn column;
  column.metric = {.metric = "n_lines", .label = "lines", .unit = "", .direction = direction, .doc = "lines"};
  column.seeds = ours[0][0].size();
  column.methods = {{"lt", "LT"}, {"iepf", "IEPF"}, {"smf", "SMF"}};
  for (std::size_t s = 0; s < paper.size(); ++s) {
    column.subjects.push_back(std::to_string(s + 1));
    for (std::size_t m = 0; m < 3; ++m) column.cells.push_back({paper[s][m], "", ours[s][m]});
  }
  return column;
}

/// "1: SMF < LT" for every ordering, those that do not hold with a "!" in front.
std::vector<std::string> texts(const ComparedColumn& column) {
  std::vector<std::string> result;
  for (const auto& o : orderings(column))
    result.push_back((o.holds ? "" : "!") + column.subjects[o.subject] + ": " + column.methods[o.lower].published +
                     " < " + column.methods[o.upper].published);
  return result;
}

TEST(Orderings, AreThePairsWithDifferentPrintedValues) {
  // Line 1: SMF < LT < IEPF, and so have we. Line 2: LT = IEPF > SMF; our medians are 3, 2, 2.
  const auto column = column_of({{2, 3, 1}, {2, 2, 1}}, {{{2.5}, {4.0}, {1.5}}, {{3.0}, {2.0}, {2.0}}});
  EXPECT_THAT(texts(column),
              ElementsAre("1: LT < IEPF", "1: SMF < LT", "1: SMF < IEPF", "2: SMF < LT", "!2: SMF < IEPF"));
  EXPECT_THAT(orderings_per_seed(column), ElementsAre(4));
}

TEST(Orderings, HoldByTheMediansAndAreCountedSeedBySeed) {
  // Medians of seeds: LT 2, IEPF 3. Seed by seed LT < IEPF: 1 < 3, 2 < 4, not 9 < 1.
  const auto column = column_of({{1, 2, kNone}}, {{{1, 2, 9}, {3, 4, 1}, {0, 0, 0}}});
  const auto found = orderings(column);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].holds);
  EXPECT_EQ(found[0].seeds_holding, 2U);
  EXPECT_THAT(orderings_per_seed(column), ElementsAre(1, 1, 0));
}

TEST(Orderings, OfAnUndefinedValueDoNotHold) {
  const auto column = column_of({{1, 2, kNone}}, {{{kNone}, {3}, {0}}});
  EXPECT_THAT(texts(column), ElementsAre("!1: LT < IEPF"));
}

TEST(Orderings, OfSettingsAreThoseOfOneSettingOrOneFamily) {
  ComparedColumn column;
  column.seeds = 1;
  column.methods = {{"a", "SEF T=6cm"}, {"b", "SEF T=9cm"}, {"c", "LT T=6cm"}, {"d", "LT T=8cm"}};
  column.subjects = {"all"};
  column.cells = {{128, "", {90}}, {116, "", {95}}, {50, "", {40}}, {38, "", {30}}};
  EXPECT_THAT(texts(column),
              ElementsAre("!all: SEF T=9cm < SEF T=6cm", "all: LT T=6cm < SEF T=6cm", "all: LT T=8cm < LT T=6cm"));
}

TEST(SplitMethod, TakesTheLastWordWithAnEqualsSignForTheSetting) {
  EXPECT_EQ(study::split_method("SEF T=6cm").family, "SEF");
  EXPECT_EQ(study::split_method("SEF T=6cm").setting, "T=6cm");
  EXPECT_EQ(study::split_method("mean shift").family, "mean shift");
  EXPECT_EQ(study::split_method("SMF").setting, "");
}

TEST(BestCounts, CountLinesWhereNoOtherMethodIsBetter) {
  // Two seeds. Paper: SMF is best on lines 1 and 2, LT and IEPF share line 3, line 4 is not printed. Our medians: line
  // 1 SMF; line 2 LT (1.5 of 1.5, 2.75, 2); line 3 SMF. Seed 1: SMF, LT, SMF; seed 2: IEPF, SMF, a tie of LT and SMF.
  const auto column = column_of(
      {{2, 3, 1}, {2, 3, 1}, {1, 1, 2}, {kNone, kNone, kNone}},
      {{{4, 4}, {5, 2}, {1, 3}}, {{0, 3}, {3, 2.5}, {2, 2}}, {{3, 2}, {3, 3}, {1, 2}}, {{9, 9}, {9, 9}, {0, 0}}});
  EXPECT_EQ(column.printed_subjects(), 3U);
  const auto alone = best_counts(column, Ties::nobodys);
  ASSERT_EQ(alone.size(), 3U);
  EXPECT_EQ(alone[0].paper, 0U);
  EXPECT_EQ(alone[1].paper, 0U);
  EXPECT_EQ(alone[2].paper, 2U);
  EXPECT_EQ(alone[0].median, 1U);
  EXPECT_EQ(alone[1].median, 0U);
  EXPECT_EQ(alone[2].median, 2U);
  EXPECT_THAT(alone[0].per_seed, ElementsAre(1, 0));
  EXPECT_THAT(alone[1].per_seed, ElementsAre(0, 1));
  EXPECT_THAT(alone[2].per_seed, ElementsAre(2, 1));
  const auto shared = best_counts(column, Ties::shared);
  EXPECT_EQ(shared[0].paper, 1U);
  EXPECT_EQ(shared[1].paper, 1U);
  EXPECT_EQ(shared[2].median, 2U);
  EXPECT_THAT(shared[0].per_seed, ElementsAre(1, 1));
  EXPECT_THAT(shared[2].per_seed, ElementsAre(2, 2));
}

TEST(BestCounts, KnowThatMoreMayBeBetterAndThatUndefinedIsNotBest) {
  const auto column = column_of({{0.5, 0.9, 0.7}}, {{{kNone}, {0.2}, {0.1}}}, Direction::higher_is_better);
  const auto counts = best_counts(column, Ties::shared);
  EXPECT_EQ(counts[1].paper, 1U);
  EXPECT_EQ(counts[1].median, 1U);
  EXPECT_THAT(best_counts(column_of({{1, 2, 3}}, {{{1}, {2}, {3}}}, Direction::neither), Ties::shared), IsEmpty());
}

TEST(CorrelationOfCells, IsPearsonsOverAllPrintedCells) {
  // Pairs (1, 1), (2, 3), (3, 2): covariance 0.5, variances 1 and 1. Seed 1: 1, 3, 1 -> 0; seed 2: 1, 3, 3 -> 0.866.
  const auto column =
      column_of({{1, 2, 3}, {kNone, kNone, kNone}}, {{{1, 1}, {3, 3}, {1, 3}}, {{7, 7}, {7, 7}, {7, 7}}});
  const auto r = correlation(column);
  EXPECT_EQ(r.cells, 3U);
  EXPECT_NEAR(r.of_medians, 0.5, 1e-15);
  ASSERT_EQ(r.per_seed.size(), 2U);
  EXPECT_NEAR(r.per_seed[0], 0.0, 1e-15);
  EXPECT_NEAR(r.per_seed[1], std::sqrt(0.75), 1e-15);
}

class PublishedFile : public ::testing::Test {
 protected:
  study::Scenario scenario_with_published(const std::string& csv) {
    io::write_file_atomically(folder_.path() / "paper.csv", csv);
    study::Scenario scenario = fixtures::scenario_with(
        "rooms", {fixtures::extract_with("lt", "test_line"), fixtures::extract_with("other", "test_line")});
    scenario.seeds = {4, 9};
    scenario.pipelines[0].published = "LT T=6cm";
    scenario.published_file = folder_.path() / "paper.csv";
    return scenario;
  }
  support::TemporaryFolder folder_;
};

TEST_F(PublishedFile, IsPairedWithOursByMetricSubjectMethodAndSeed) {
  const auto scenario = scenario_with_published(
      "metric,subject,method,value,unit,table\n"
      "eps,1,LT T=6cm,4.10,cm,2\n"
      "eps,2,LT T=6cm,5,cm,2\n"
      "eps,1,SEF T=6cm,9,cm,2\n"
      "look,all,LT T=6cm,++,rating,2\n");
  const std::vector<runs::SummaryRow> rows{{"rooms", "lt", 9, "eps", "1", 0.06, "m", 1},
                                           {"rooms", "lt", 4, "eps", "1", 0.05, "m", 1},
                                           {"rooms", "other", 4, "eps", "3", 0.01, "m", 1},
                                           {"halls", "lt", 4, "eps", "2", 0.01, "m", 1}};
  const auto columns = compare_with_paper(scenario, rows);
  ASSERT_EQ(columns.size(), 2U);
  EXPECT_EQ(columns[0].table, "2");
  EXPECT_EQ(columns[0].methods.size(), 2U);  // no pipeline names SEF
  EXPECT_THAT(columns[0].subjects, ElementsAre("1", "2", "3"));
  EXPECT_DOUBLE_EQ(columns[0].at(0, 0).paper, 0.041);
  EXPECT_EQ(columns[0].at(0, 0).printed, "4.10");
  EXPECT_THAT(columns[0].at(0, 0).ours, ElementsAre(0.05, 0.06));
  EXPECT_DOUBLE_EQ(columns[0].at(0, 0).our_median(), 0.055);
  EXPECT_TRUE(std::isnan(columns[0].at(1, 0).our_median()));
  EXPECT_TRUE(std::isnan(columns[0].at(2, 1).paper));
  EXPECT_EQ(columns[1].at(0, 0).printed, "++");
  EXPECT_TRUE(std::isnan(columns[1].at(0, 0).paper));
}

TEST_F(PublishedFile, WithAWordForANumberIsRefusedWithItsLine) {
  const auto scenario = scenario_with_published("metric,subject,method,value,unit\neps,1,LT,4.1x,cm\n");
  try {
    compare_with_paper(scenario, {});
    FAIL() << "was accepted";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("paper.csv:2"));
  }
}

TEST(ComparedScenario, WithoutPublishedValuesHasNone) {
  EXPECT_THAT(compare_with_paper(fixtures::scenario_with("rooms", {fixtures::extract_with("lt", "test_line")}), {}),
              IsEmpty());
}

TEST(PaperTables, ShowOursNextToThePrintedAndTheBestOfEither) {
  auto column = column_of({{2, 3, 1}}, {{{1}, {3}, {2}}});
  column.table = "1";
  for (std::size_t m = 0; m < 3; ++m) column.cells[m].printed = std::vector{"2.00", "3.00", "1.00"}[m];
  const auto tables = paper_tables("rooms", {column});
  ASSERT_EQ(tables.size(), 1U);
  const std::string text = to_terminal(tables[0], false);
  EXPECT_THAT(text, HasSubstr("line     lt  paper  iepf  paper   smf  paper"));
  EXPECT_THAT(text, HasSubstr("1     1.00*   2.00  3.00   3.00  2.00  1.00*"));
}

TEST(PaperTables, HaveARowForEachLineOfAnyColumn) {
  auto few = column_of({{2, 3, 1}}, {{{1}, {3}, {2}}});
  auto more = column_of({{5, 6, 4}, {8, 9, 7}, {1, 2, 3}}, {{{1}, {3}, {2}}, {{4}, {6}, {5}}, {{7}, {9}, {8}}});
  ASSERT_EQ(more.subjects.size(), 3U);
  few.table = more.table = "1";
  const auto tables = paper_tables("rooms", {few, more});
  ASSERT_EQ(tables.size(), 1U);
  ASSERT_EQ(tables[0].rows.size(), 3U);
  for (std::size_t r = 0; r < 3; ++r) {
    EXPECT_THAT(tables[0].rows[r].heads, ElementsAre(more.subjects[r]));
    EXPECT_EQ(tables[0].rows[r].cells.size(), tables[0].columns.size());
  }
  EXPECT_EQ(tables[0].rows[0].cells[0].text, "1");
  EXPECT_EQ(tables[0].rows[2].cells[0].text, "–");  // the first column has no such line
  EXPECT_EQ(tables[0].rows[2].cells[6].text, "7");
}

TEST(PaperTables, ShowTimesAsRatiosToTheFirstFamily) {
  ComparedColumn column;
  column.metric = {.metric = "t", .label = "time", .unit = "ms", .doc = "time", .timing = true};
  column.printed_unit = "ms";
  column.seeds = 1;
  column.methods = {{"a", "SEF T=6cm"}, {"b", "SEF T=9cm"}, {"c", "LT T=6cm"}};
  column.subjects = {"all"};
  column.cells = {{60, "60", {0.001}}, {40, "40", {0.003}}, {100, "100", {0.005}}};
  const auto tables = paper_tables("rooms", {column});
  ASSERT_EQ(tables.size(), 2U);
  EXPECT_EQ(tables[1].rows[2].cells[0].text, "2.50");  // 0.005 over the mean of 0.001 and 0.003
  EXPECT_EQ(tables[1].rows[2].cells[1].text, "2.00");  // 100 over the mean of 60 and 40
  // Ours need another unit than the paper's: every value has its own, and the head has none.
  EXPECT_EQ(tables[0].columns[0].group, "t");
  EXPECT_EQ(tables[0].columns[1].group, "t");
  EXPECT_EQ(tables[0].rows[0].cells[0].text, "1.00 µs");
  EXPECT_EQ(tables[0].rows[0].cells[1].text, "60 ms");
}

TEST(DepartureTables, ListWhatDoesNotHoldAndNothingElse) {
  const auto column = column_of({{2, 3, 1}}, {{{1, 1}, {3, 3}, {2, 0}}});
  const auto tables = departure_tables("rooms", {column});
  ASSERT_EQ(tables.size(), 1U);
  EXPECT_THAT(tables[0].title, HasSubstr("(1 of 3 orderings)"));
  ASSERT_EQ(tables[0].rows.size(), 1U);
  EXPECT_THAT(tables[0].rows[0].heads, ElementsAre("lines", "1", "SMF < LT"));
  EXPECT_EQ(tables[0].rows[0].cells.back().text, "1 of 2");  // medians 1 and 1: a tie does not hold
}

TEST(AgreementTables, ShowTheSpreadOverSeedsWithHalfMedians) {
  const auto column = column_of({{2, 3, 1}}, {{{1, 1}, {3, 3}, {2, 0}}});  // 2 and 3 orderings hold
  const auto tables = agreement_tables("rooms", {column});
  ASSERT_EQ(tables.size(), 4U);  // by line, by pair, best, correlation
  EXPECT_EQ(tables[0].rows.back().cells[0].text, "2 / 2.5 / 3");
  EXPECT_EQ(tables[0].rows[0].cells[0].text, "2 of 3");
}

TEST(AgreementFiles, AreTidyTablesOfCellsOrderingsAndSummaries) {
  auto column = column_of({{2, 3, 1}}, {{{1, 1}, {3, 3}, {2, 0}}});
  column.table = "1";
  column.metric.unit = "m";
  const auto files = agreement_files({{"rooms", {column}}});
  ASSERT_EQ(files.size(), 3U);
  EXPECT_EQ(files[0].name, "cells.csv");
  EXPECT_THAT(files[0].bytes, HasSubstr("rooms,1,n_lines,1,lt,LT,,2,1,,,2,m\n"));
  EXPECT_EQ(files[1].name, "orderings.csv");
  EXPECT_THAT(files[1].bytes, HasSubstr("rooms,n_lines,1,SMF,LT,1,2,1,1,0,1,2\n"));
  EXPECT_EQ(files[2].name, "agreement.csv");
  EXPECT_THAT(files[2].bytes, HasSubstr("rooms,n_lines,orderings,,3,2,2,2.5,3,3\n"));
  EXPECT_THAT(files[2].bytes, HasSubstr("rooms,n_lines,best,LT,0,1,0,0.5,1,1\n"));
  EXPECT_THAT(files[2].bytes, HasSubstr("rooms,n_lines,best,SMF,1,1,0,0.5,1,1\n"));
  EXPECT_THAT(files[2].bytes, HasSubstr("rooms,n_lines,best_alone,SMF,1,0,0,0.5,1,1\n"));
}

}  // namespace
}  // namespace scanbench::results
