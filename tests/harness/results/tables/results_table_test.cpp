// Result tables: marks, missing cells, common input, digits.
#include "harness/results/tables/results_table.hpp"
#include "harness/results/pages/page_parts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "core/error.hpp"
#include "harness/results/document/html_page.hpp"
#include "harness/results/document/html_table.hpp"
#include "harness/results/tables/comparable_rows.hpp"
#include "harness/results/tables/table_marks.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::results {
namespace {

using fixtures::extract_with;
using metrics::Direction;
using metrics::MetricDescription;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

study::Scenario scenario_of(const std::vector<std::string>& pipelines, const std::vector<std::string>& families,
                            std::vector<std::uint64_t> seeds = {1}) {
  study::Scenario scenario;
  scenario.name = "s";
  scenario.seeds = std::move(seeds);
  for (const auto& name : pipelines) scenario.pipelines.push_back(extract_with(name, "test_line"));
  for (const auto& family : families) scenario.metrics.push_back({"metrics", family, {}});
  return scenario;
}

runs::SummaryRow row(const std::string& pipeline, const std::string& metric, double value, std::uint64_t seed = 1,
                     const std::string& subject = "all") {
  return {"s", pipeline, seed, metric, subject, value, "", 1};
}

CellLine cell(const std::string& pipeline, std::uint64_t seed, const std::string& status,
              const std::string& message = "") {
  return {"s", pipeline, seed, status, message, 0.0, 0.0};
}

/// The cell of a pipeline (by the beginning of its label) and a metric (by the beginning of its heading).
const TableCell& at(const Table& table, const std::string& pipeline, const std::string& metric) {
  for (const auto& r : table.rows)
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      if (r.heads.front().starts_with(pipeline) && table.columns[c].head.starts_with(metric)) return r.cells[c];
  throw InternalError("the table has no " + pipeline + ", " + metric);
}

std::vector<bool> marked(const std::vector<double>& values, const MetricDescription& metric,
                         const std::vector<bool>& eligible = {}) {
  std::vector<TableCell> cells;
  for (const double value : values) cells.push_back({value_text(value, {})});
  std::vector<TableCell*> pointers;
  for (auto& c : cells) pointers.push_back(&c);
  std::vector<std::vector<double>> of_one_seed;
  for (const double value : values) of_one_seed.push_back({value});
  mark_best(pointers, of_one_seed, metric, eligible);
  std::vector<bool> best;
  for (const auto& c : cells) best.push_back(c.best);
  return best;
}

TEST(MarkBest, MarksTheValuesNearestToATargetOnEitherSide) {
  const MetricDescription nees{"nees", "NEES", "", Direction::target, 0.1, "", false, 2.0};
  EXPECT_THAT(marked({0.5, 2.25, 1.75, 3.0}, nees), ElementsAre(false, true, true, false));
  EXPECT_THAT(marked({0.0, 9.0}, nees), ElementsAre(true, false));
}

TEST(MarkBest, MarksValuesThatReadTheSameAlike) {
  const MetricDescription lower{"x", "x", "", Direction::lower_is_better, 0, ""};
  EXPECT_THAT(marked({12.602, 12.601, 14}, lower), ElementsAre(true, true, false));
  EXPECT_THAT(marked({12.602, 12.601, 14}, lower, {true, false, true}), ElementsAre(true, false, false));
  EXPECT_THAT(marked({12.602, 12.601}, lower), ElementsAre(false, false));
}

TEST(MarkBest, MarksNothingWithoutADirectionACompetitorOrADifference) {
  const MetricDescription lower{"x", "x", "", Direction::lower_is_better, 0, ""};
  const MetricDescription neither{"x", "x", "", Direction::neither, 0, ""};
  const double nan = std::nan("");
  EXPECT_THAT(marked({1, 2}, neither), ElementsAre(false, false));
  EXPECT_THAT(marked({1, nan}, lower), ElementsAre(false, false));
  EXPECT_THAT(marked({1, 1, nan}, lower), ElementsAre(false, false, false));
  EXPECT_THAT(marked({1, 2, nan}, lower), ElementsAre(true, false, false));
  EXPECT_THAT(marked({1, 2, 2}, lower, {false, true, true}), ElementsAre(false, true, true));
  EXPECT_THAT(marked({-std::numeric_limits<double>::infinity(), 2, 3}, lower), ElementsAre(false, true, false));
}

TEST(MarkBest, SharesTheMarkAmongValuesThatTheSeedsDoNotTellApart) {
  const MetricDescription lower{"x", "x", "", Direction::lower_is_better, 0, ""};
  std::vector<TableCell> cells{{"a"}, {"b"}, {"c"}, {"d"}};
  std::vector<TableCell*> pointers;
  for (auto& c : cells) pointers.push_back(&c);
  const std::vector<double> a{1.0, 1.2, 1.4, 1.6, 1.8, 2.0};
  std::vector<double> b = a, c = a;
  for (std::size_t k = 0; k < a.size(); ++k) {
    b[k] += k % 2 == 0 ? 0.3 : -0.2;  // differences +0.3 and -0.2: 0.05 on average, by no means other than zero
    c[k] += 0.10 + 0.001 * static_cast<double>(k);  // far less than the spread over seeds, but in every seed
  }
  mark_best(pointers, {a, b, c, std::vector<double>(6, 0.1)}, lower, {true, true, true, false});
  EXPECT_TRUE(cells[0].best);
  EXPECT_TRUE(cells[1].best);
  EXPECT_FALSE(cells[2].best);
  EXPECT_FALSE(cells[3].best);
  EXPECT_TRUE(cells[3].not_eligible);
  EXPECT_FALSE(cells[2].not_eligible);
  Table table{"t", "", "", {"pipeline"}, {{"", "x", false}}, {{{"d"}, {cells[3]}, false}}};
  EXPECT_THAT(to_html(table), HasSubstr("<td class=\"not-eligible"));
}

TEST(MarkBest, OfFewSeedsNeedsEverySeedToAgree) {
  const MetricDescription higher{"x", "x", "", Direction::higher_is_better, 0, ""};
  std::vector<TableCell> cells{{"a"}, {"b"}, {"c"}};
  std::vector<TableCell*> pointers;
  for (auto& c : cells) pointers.push_back(&c);
  const std::vector<std::vector<double>> seeds{{0.9, 0.8, 0.9}, {0.8, 0.81, 0.8}, {0.8, 0.79, 0.89}};
  mark_best(pointers, seeds, higher);
  EXPECT_TRUE(cells[0].best);
  EXPECT_TRUE(cells[1].best);   // better in the second seed
  EXPECT_FALSE(cells[2].best);  // worse in each
}

TEST(SeedsText, ShowsARangeOfFewSeedsAndNoValueThatCannotBe) {
  EXPECT_EQ(seeds_text({0.5}, ValueRange::share, {}), "0.500");
  EXPECT_EQ(seeds_text({0.97, 1.0, 0.5}, ValueRange::share, {}), "0.823 (0.500 to 1.00)");
  EXPECT_EQ(seeds_text({0.50, 0.51, 0.49, 0.50, 0.52, 0.48}, ValueRange::share, {}).substr(0, 8), "0.500 \u00B1");
  const std::string lopsided = seeds_text({1, 1, 1, 1, 1, 0.7}, ValueRange::share, {});
  EXPECT_THAT(lopsided, AllOf(HasSubstr("0.950 ("), HasSubstr(" to 1.00)"), Not(HasSubstr("\u00B1"))));
}

TEST(ResultTables, GiveAPipelineThatFindsNothingNoMarkForItsTime) {
  const study::Scenario scenario = scenario_of({"a", "b"}, {"segments", "timing"});
  const auto tables = result_tables(
      scenario,
      comparable_rows(scenario, {row("a", "f1", 0), row("b", "f1", 0), row("a", "t_scan", 2), row("b", "t_scan", 3)}));
  for (const auto& table : tables)
    for (const auto& line : table.rows)
      for (const auto& value : line.cells) EXPECT_FALSE(value.best) << table.id;
}

TEST(ResultTables, GiveNoMarkOnALineThatIsMissedInMostScans) {
  const study::Scenario scenario = scenario_of({"a", "b"}, {"borges2000"});
  std::vector<runs::SummaryRow> rows;
  for (const auto& [pipeline, missed, eta] : {std::tuple{"a", 0.98, 1.0}, std::tuple{"b", 0.10, 0.7}}) {
    rows.push_back(row(pipeline, "missed", missed, 1, "7"));
    rows.push_back(row(pipeline, "eta", eta, 1, "7"));
    rows.push_back(row(pipeline, "missed", 0.05, 1, "mean"));
  }
  const auto tables = result_tables(scenario, comparable_rows(scenario, rows));
  ASSERT_EQ(tables.size(), 1U);
  const auto& line = tables[0].rows.at(0);
  ASSERT_EQ(line.heads.front(), "7");
  for (std::size_t c = 0; c < line.cells.size(); ++c) {
    EXPECT_EQ(line.cells[c].best, tables[0].columns[c].head == "b") << tables[0].columns[c].group;
    EXPECT_EQ(line.cells[c].not_eligible, tables[0].columns[c].head == "a") << tables[0].columns[c].group;
  }
}

// Thirty walls: one map has all of them, one has twelve lines and covers a third.
TEST(ResultTables, GiveAMapThatMissesWallsNoMarkForBeingSmall) {
  const study::Scenario scenario = scenario_of({"right", "coarse", "small"}, {"map_truth", "timing"});
  std::vector<runs::SummaryRow> rows;
  const auto add = [&](const std::string& pipeline, double covered, double per_wall, double duplicates, double t) {
    rows.push_back(row(pipeline, "covered_5cm", covered));
    rows.push_back(row(pipeline, "lines_per_wall", per_wall));
    rows.push_back(row(pipeline, "duplicates", duplicates));
    rows.push_back(row(pipeline, "t_scan", t));
  };
  add("right", 0.99, 1.1, 3, 30);
  add("coarse", 0.97, 1.5, 5, 20);
  add("small", 0.36, 0.4, 0, 10);
  const auto tables = result_tables(scenario, comparable_rows(scenario, rows));
  ASSERT_EQ(tables.size(), 2U);
  for (const char* metric : {"covered_5cm", "lines_per_wall", "duplicates"}) {
    EXPECT_TRUE(at(tables[0], "right", metric).best) << metric;
    EXPECT_FALSE(at(tables[0], "small", metric).best) << metric;
  }
  EXPECT_TRUE(at(tables[1], "coarse", "t_scan").best);
  EXPECT_FALSE(at(tables[1], "small", "t_scan").best);
  EXPECT_THAT(tables[1].caption, HasSubstr("within 0.05 of the best walls covered within 5 cm"));
}

TEST(ResultTables, SayHowManyCellsAPipelineFinishedAndMarkNoneThatDidNotFinishAll) {
  const study::Scenario scenario = scenario_of({"good", "fragile", "broken"}, {"segments"}, {1, 2, 3});
  std::vector<runs::SummaryRow> rows{row("good", "f1", 0.9, 1), row("good", "f1", 0.7, 2), row("good", "f1", 0.1, 3),
                                     row("fragile", "f1", 1.0, 1), row("fragile", "f1", 1.0, 2)};
  const std::vector<CellLine> cells{
      cell("good", 1, "ok"),        cell("good", 2, "ok"),        cell("good", 3, "ok"),
      cell("fragile", 1, "ok"),     cell("fragile", 2, "ok"),     cell("fragile", 3, "crashed"),
      cell("broken", 1, "timeout"), cell("broken", 2, "timeout"), cell("broken", 3, "timeout")};
  const ComparableRows results = comparable_rows(scenario, rows, cells);
  EXPECT_THAT(results.seeds, ElementsAre(1, 2));
  const auto tables = result_tables(restricted(scenario, results), results);
  ASSERT_EQ(tables.size(), 1U);
  EXPECT_THAT(tables[0].rows[1].note, HasSubstr("2 of 3 ok, 1 crashed"));
  EXPECT_FALSE(at(tables[0], "fragile", "f1").best);
  EXPECT_TRUE(at(tables[0], "good", "f1").best);
  EXPECT_THAT(at(tables[0], "good", "f1").text,
              HasSubstr("0.800 (0.700 to 0.900)"));  // of seeds 1 and 2, as the other's
  EXPECT_EQ(at(tables[0], "broken", "f1").text, "timeout");
  EXPECT_THAT(tables[0].caption, AllOf(HasSubstr("2 of 3 seeds"), HasSubstr("no mark")));
}

TEST(ResultTables, ExplainNoMarksOfASinglePipeline) {
  const auto caption = [](const std::vector<std::string>& pipelines) {
    const study::Scenario scenario = scenario_of(pipelines, {"segments"});
    std::vector<runs::SummaryRow> rows;
    std::vector<CellLine> cells;
    for (const auto& name : pipelines) {
      rows.push_back(row(name, "f1", 1));
      cells.push_back(cell(name, 1, "ok"));
    }
    return result_tables(scenario, comparable_rows(scenario, rows, cells)).front().caption;
  };
  EXPECT_THAT(caption({"a"}), IsEmpty());
  EXPECT_THAT(caption({"a", "b"}), HasSubstr("* marks the best value"));
}

TEST(ResultTables, CountTheSeedsInWhichAValueIsDefined) {
  const study::Scenario scenario = scenario_of({"a", "b"}, {"segments"}, {1, 2});
  const auto tables = result_tables(
      scenario, comparable_rows(scenario, {row("a", "sigma_angle", 1.0, 1), row("a", "sigma_angle", std::nan(""), 2),
                                           row("b", "sigma_angle", 2.0, 1), row("b", "sigma_angle", 2.0, 2)}));
  EXPECT_THAT(at(tables.at(0), "a", "sigma_angle").text, HasSubstr("(1 of 2)"));
  EXPECT_FALSE(at(tables.at(0), "a", "sigma_angle").best);
}

TEST(ComparableRows, AverageOverTheLinesOnWhichEveryPipelineHasAValue) {
  const study::Scenario scenario = scenario_of({"a", "b"}, {"borges2000"});
  std::vector<runs::SummaryRow> rows;
  const auto add = [&](const std::string& pipeline, const std::vector<double>& lines, double mean) {
    for (std::size_t i = 0; i < lines.size(); ++i)
      rows.push_back(row(pipeline, "n_lines", lines[i], 1, "wall " + std::to_string(i + 1)));
    rows.push_back(row(pipeline, "n_lines", mean, 1, "mean"));
  };
  add("a", {1.0, 1.5, std::nan("")}, 1.25);
  add("b", {2.0, 3.0, 10.0}, 5.0);
  const ComparableRows results = comparable_rows(scenario, rows);
  for (const auto& r : results.rows) {
    if (r.subject == "mean") {
      EXPECT_EQ(r.value, r.pipeline == "a" ? 1.25 : 2.5);
    }
  }
  ASSERT_EQ(results.line_notes.size(), 1U);
  EXPECT_THAT(results.line_notes[0].text, AllOf(HasSubstr("lines per wall"), HasSubstr("without wall 3")));
}

TEST(ComparableRows, LeaveOutPipelinesThatWereNotSelected) {
  const study::Scenario scenario = scenario_of({"a", "b"}, {"segments"});
  std::vector<CellLine> cells{cell("a", 1, "ok"), cell("b", 1, "missing", "not run")};
  cells[1].selected = false;
  const ComparableRows results = comparable_rows(scenario, {row("a", "f1", 0.5)}, cells);
  EXPECT_THAT(results.pipelines, ElementsAre("a"));
  EXPECT_THAT(results.notes, IsEmpty());
  for (const auto& text : {to_html(status_blocks(cells)), to_markdown(status_blocks(cells))})
    EXPECT_THAT(text, AllOf(HasSubstr("1 of 2 cells selected, all ok"), Not(HasSubstr("not run"))));
}

TEST(ResultTables, SayWhichAlignersHaveNotConverged) {
  const study::Scenario scenario = scenario_of({"a", "b"}, {"segments"});
  const std::vector<CellLine> cells{cell("a", 1, "ok", "align: 1 max_iterations"), cell("b", 1, "ok")};
  const ComparableRows results = comparable_rows(scenario, {row("a", "f1", 0.5), row("b", "f1", 0.4)}, cells);
  EXPECT_EQ(result_tables(scenario, results).at(0).rows[0].note, "not converged");
  EXPECT_EQ(result_tables(scenario, results).at(0).rows[1].note, "");
  for (const auto& text : {to_html(status_blocks(cells)), to_markdown(status_blocks(cells))})
    EXPECT_THAT(text, HasSubstr("all 2 cells ok"));
  for (const auto& text : {to_html(remark_blocks(cells)), to_markdown(remark_blocks(cells))})
    EXPECT_THAT(text, HasSubstr("align: 1 max_iterations"));
}

TEST(ResultTables, SayOnHowManyScansAMatcherOrMapperHasNoMatchOrHasNotConverged) {
  const study::Scenario scenario = scenario_of({"a", "b", "c"}, {"segments"});
  const std::vector<CellLine> cells{
      cell("a", 1, "ok", "match: 24 max_iterations, 57 degenerate; map: 3 no_match (first in frame 0: no lines)"),
      cell("b", 1, "ok", "match: 1 no_match"), cell("c", 1, "ok", "match: 400 degenerate")};
  const ComparableRows results =
      comparable_rows(scenario, {row("a", "f1", 0.5), row("b", "f1", 0.4), row("c", "f1", 0.3)}, cells);
  const std::vector<Table> tables = result_tables(scenario, results);
  EXPECT_EQ(tables.at(0).rows[0].note, "no match on 3 scans; not converged on 24 scans");
  EXPECT_EQ(tables.at(0).rows[1].note, "no match on 1 scan");
  EXPECT_EQ(tables.at(0).rows[2].note, "") << "an open motion is an answer";
}

TEST(ResultTables, GiveRemarksThatDifferInTheirNumbersOneRow) {
  const std::vector<CellLine> cells{cell("a", 1, "ok", "align: 1 max_iterations"),
                                    cell("a", 2, "ok", "align: 7 max_iterations"),
                                    cell("a", 3, "ok", "align: 7 degenerate")};
  EXPECT_THAT(to_markdown(remark_blocks(cells)),
              AllOf(HasSubstr("for example align: 1 max_iterations | 2 |"), HasSubstr("align: 7 degenerate | 1 |")));
}

TEST(Remarks, NameTheScenarioOfARowThatHasOne) {
  std::vector<CellLine> cells;
  for (int k = 0; k < 26; ++k) {  // so many rows that scenarios are taken together
    cells.push_back(cell("a", 1, "ok", "match: 1 degenerate"));
    cells.back().scenario = "s" + std::to_string(k);
  }
  cells.push_back(cell("b", 1, "ok", "match: 1 no_match"));
  EXPECT_THAT(to_markdown(remark_blocks(cells)), AllOf(HasSubstr("| 26 scenarios | a |"), HasSubstr("| s | b |")));
}

TEST(Display, ShowsThreeDigitsOfEveryValueAndNoValueAsZero) {
  const Display metres = display_for("m", 12.0);
  EXPECT_EQ(metres.unit, "m");
  EXPECT_EQ(value_text(12.0, metres), "12.0");
  EXPECT_EQ(value_text(0.0012, metres), "0.00120");
  EXPECT_EQ(value_text(0.0, metres), "0");
  EXPECT_EQ(value_text(-0.5, metres), "-0.500");
  EXPECT_EQ(value_text(1538.0, metres), "1538");
  EXPECT_EQ(value_text(std::nan(""), metres), "–");
  EXPECT_EQ(value_text(2e-12, metres), "2.00e-12");
  EXPECT_EQ(spread_text(0.126, metres), "± 0.13");
  EXPECT_EQ(spread_text(std::nan(""), metres), "");
  const Display as_printed{"cm", 100.0, 1};
  EXPECT_EQ(value_text(0.0123, as_printed), "1.2");
  EXPECT_EQ(value_text(0.0001, as_printed), "0.0100");
}

TEST(Display, ShowsSmallTimesInMicroseconds) {
  for (const auto& [unit, value] : {std::pair{"s", 4.2e-5}, std::pair{"ms", 4.2e-2}, std::pair{"us", 42.0}}) {
    const Display display = display_for(unit, value);
    EXPECT_EQ(display.unit, "µs");
    EXPECT_EQ(value_text(value, display), "42.0");
  }
  EXPECT_EQ(display_for("s", 0.5).unit, "ms");
  EXPECT_EQ(display_for("ms", 12.0).unit, "ms");
}

TEST(Overview, DoesNotCallAnExtractorBestForItsDistancesOrItsTime) {
  const study::Scenario scenario = scenario_of({"a", "b"}, {"siadat1997", "timing"});
  const auto sentence = [&](const std::vector<runs::SummaryRow>& rows) {
    const auto table =
        overview_table(scenario, comparable_rows(scenario, rows, {cell("a", 1, "ok"), cell("b", 1, "ok")}));
    return table ? overview_sentence(*table) : std::string();
  };
  EXPECT_THAT(
      sentence({row("a", "d_mean", 0.01), row("b", "d_mean", 0.02), row("a", "t_scan", 3), row("b", "t_scan", 1)}),
      HasSubstr("No pipeline is called best: neither the distances"));
}

TEST(Overview, MarksNoDistanceAndNoTimeUnlessAMetricShowsWhichPipelineIsRight) {
  const study::Scenario scenario = scenario_of({"a", "b"}, {"siadat1997", "segments"});
  const std::vector<CellLine> cells{cell("a", 1, "ok"), cell("b", 1, "ok")};
  std::vector<runs::SummaryRow> rows{row("a", "d_mean", 0.01), row("b", "d_mean", 0.02), row("a", "t_total", 3),
                                     row("b", "t_total", 1)};
  const auto without = overview_table(scenario, comparable_rows(scenario, rows, cells));
  ASSERT_TRUE(without);
  EXPECT_FALSE(at(*without, "a", "d_mean").best);
  EXPECT_FALSE(at(*without, "b", "t_total").best);
  EXPECT_THAT(without->caption, HasSubstr("no value is marked as the best"));
  for (const auto& table : result_tables(scenario, comparable_rows(scenario, rows, cells), {}))
    for (const auto& line : table.rows)
      for (const auto& value : line.cells) EXPECT_FALSE(value.best) << table.id;
  rows.push_back(row("a", "f1", 0.90));
  rows.push_back(row("b", "f1", 0.91));
  const auto with = overview_table(scenario, comparable_rows(scenario, rows, cells));
  ASSERT_TRUE(with);
  EXPECT_TRUE(at(*with, "a", "d_mean").best);
  EXPECT_TRUE(at(*with, "b", "t_total").best);
}

TEST(Overview, OfOnePipelineSaysWhatItFound) {
  const study::Scenario scenario = scenario_of({"mine"}, {"siadat1997"});
  const std::vector<runs::SummaryRow> rows{row("mine", "s_mean", 12.5), row("mine", "d_mean", 0.0042),
                                           row("mine", "t_total", 3)};
  const auto table = overview_table(scenario, comparable_rows(scenario, rows, {cell("mine", 1, "ok")}));
  ASSERT_TRUE(table);
  EXPECT_EQ(overview_sentence(*table),
            "mine found: segments per scan 12.5; point distance, by segment 0.420 cm; total time 3 ms.");
}

// Placed scans are wrong by millimetres; a pipeline that places none is wrong by metres.
TEST(ResultTables, ShowAllValuesOfAMetricInTheUnitOfMostOfThem) {
  const study::Scenario scenario = scenario_of({"a", "b", "c"}, {"alignment"});
  const auto tables = result_tables(
      scenario, comparable_rows(scenario, {row("a", "position_error", 0.0027), row("b", "position_error", 0.0038),
                                           row("c", "position_error", 2.5)}));
  EXPECT_EQ(at(tables.at(0), "a", "position_error [cm]").text, "0.270");
  EXPECT_EQ(at(tables.at(0), "c", "position_error [cm]").text, "250");
}

TEST(PageHeads, HaveTheLabelTheUnitAndWhichValuesAreBetter) {
  const study::Scenario scenario = scenario_of({"a"}, {"segments", "efficiency"});
  const auto tables =
      result_tables(scenario, comparable_rows(scenario, {row("a", "f1", 0.9), row("a", "sigma_offset", 0.004),
                                                         row("a", "n_true", 7), row("a", "nees", 2.5)}));
  ASSERT_EQ(tables.size(), 2U);
  std::vector<std::string> heads;
  for (const auto& table : tables)
    for (const auto& column : table.columns) heads.push_back(page_head(column));
  EXPECT_THAT(heads, ElementsAre("F1 ↑", "offset error [cm] ↓", "true lines", "NEES ≈ 2"));
}

TEST(Overview, CountsThePipelinesThatShareTheBestValueRatherThanNameThemAll) {
  const std::vector<std::string> names{"a", "b", "c", "d", "e"};
  const study::Scenario scenario = scenario_of(names, {"map_truth"});
  std::vector<runs::SummaryRow> rows;
  std::vector<CellLine> cells;
  for (const auto& name : names) {
    rows.push_back(row(name, "covered_5cm", name == "e" ? 0.97 : 1.0));
    rows.push_back(row(name, "lines_per_wall", name == "a" || name == "e" ? 1.0 : 1.5));
    cells.push_back(cell(name, 1, "ok"));
  }
  const auto table = overview_table(scenario, comparable_rows(scenario, rows, cells));
  ASSERT_TRUE(table);
  EXPECT_EQ(overview_sentence(*table),
            "4 of 5 pipelines share the best walls covered within 5 cm, 1.00; of these, best map lines per wall: a "
            "(1.00).");
  EXPECT_THAT(best_pipelines(*table), ElementsAre("a", "b", "c", "d"));
}

TEST(OdometrySentence, NamesThePipelinesThatAreNoBetter) {
  const std::vector<std::string> names{"a", "b", "odometry"};
  const study::Scenario scenario = scenario_of(names, {"trajectory"});
  const auto sentence = [&](double of_a, double of_b) {
    std::vector<runs::SummaryRow> rows;
    std::vector<CellLine> cells;
    for (const auto& name : names) {
      rows.push_back(row(name, "rpe_position", name == "a" ? of_a : name == "b" ? of_b : 0.0729));
      rows.push_back(row(name, "rpe_odometry_position", 0.0729));
      cells.push_back(cell(name, 1, "ok"));
    }
    return odometry_sentence(comparable_rows(scenario, rows, cells));
  };
  EXPECT_EQ(sentence(0.06, 0.121),
            "No better between consecutive scans than the odometry (RPE, position: 7.29 cm): b (12.1 cm).");
  EXPECT_EQ(sentence(0.06, 0.07),
            "Every pipeline errs less between consecutive scans than the odometry (RPE, position: 7.29 cm).");
  EXPECT_EQ(
      sentence(0.06, std::nan("")),
      "1 of 2 pipelines err less between consecutive scans than the odometry (RPE, position: 7.29 cm); 1 without a "
      "value.");
  EXPECT_EQ(odometry_sentence(comparable_rows(scenario, {}, {})), "");
}

TEST(Overview, NamesWhatHeadingsAndIndependentRelationsOfALogPrefer) {
  const study::Scenario scenario = scenario_of({"a", "b"}, {"trajectory"});
  const std::vector<CellLine> cells{cell("a", 1, "ok"), cell("b", 1, "ok")};
  std::vector<runs::SummaryRow> rows{row("a", "rpe_position", 0.038), row("b", "rpe_position", 0.045),
                                     row("a", "relations_position", 1.35), row("b", "relations_position", 1.21)};
  const auto sentence = [&] {
    return overview_sentence(*overview_table(scenario, comparable_rows(scenario, rows, cells)));
  };
  EXPECT_EQ(sentence(),
            "Best RPE, position [cm] of 2 pipelines: a (3.80); best relations error, position [m]: b (1.21).");
  rows.back().value = 1.5;
  EXPECT_EQ(sentence(), "Best RPE, position [cm] of 2 pipelines: a (3.80).");
  rows.push_back(row("a", "rpe_heading", 0.9));
  rows.push_back(row("b", "rpe_heading", 0.7));
  EXPECT_EQ(sentence(), "Best RPE, position [cm] of 2 pipelines: a (3.80); best RPE, heading [deg]: b (0.700).");
}

}  // namespace
}  // namespace scanbench::results
