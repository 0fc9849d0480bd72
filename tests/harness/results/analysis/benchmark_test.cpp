// Averages, ranks and tests of a benchmark against cases worked out by hand; the page of a small run.
#include "harness/results/analysis/benchmark.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "harness/io/files/atomic_file.hpp"
#include "harness/results/analysis/error_bins.hpp"
#include "harness/results/document/html_page.hpp"
#include "harness/results/document/html_table.hpp"
#include "harness/results/tables/level_table.hpp"
#include "harness/results/tables/ranking_table.hpp"
#include "harness/runs/store/run_scenarios.hpp"
#include "harness/runs/store/summary.hpp"
#include "harness/study/scenario/benchmark_spec.hpp"
#include "harness/study/scenario/scenario_file.hpp"
#include "tests/harness/results/analysis/benchmark_scenes.hpp"
#include "tests/support/inputs.hpp"

namespace scanbench::results {
namespace {

using ::testing::HasSubstr;

/// Rows of one pipeline: values at x/1, y/1, x/2, y/2.
void add_rows(std::vector<runs::SummaryRow>& rows, const std::string& pipeline, const std::string& metric,
              const std::vector<double>& values) {
  std::size_t i = 0;
  for (const std::uint64_t seed : {1U, 2U})
    for (const char* scenario : {"x", "y"})
      rows.push_back({scenario, pipeline, seed, metric, "all", values.at(i++), "", 10});
}

std::vector<runs::SummaryRow> made_up_rows() {
  std::vector<runs::SummaryRow> rows;
  add_rows(rows, "a", "f1", {0.9, 0.7, 0.8, 0.8});
  add_rows(rows, "b", "f1", {0.8, 0.8, 0.9, 0.9});
  add_rows(rows, "c", "f1", {0.5, 0.3, 0.4, 0.2});
  add_rows(rows, "a", "t_scan", {2, 8, 4, 4});
  add_rows(rows, "b", "t_scan", {1, 1, 1, 4});
  add_rows(rows, "c", "t_scan", {4, 16, 8, 8});
  add_rows(rows, "c", "sigma_offset", {std::nan(""), 0.01, 0.03, 0.05});
  return rows;
}

TEST(Benchmark, AValueWhoseTargetIsItsMeanHasTheArithmeticMeanAndItsRange) {
  study::BenchmarkSpec spec = kSpec;
  spec.of = "match";
  std::vector<runs::SummaryRow> rows;
  add_rows(rows, "a", "pose_nees", {0.3, 30.0, 0.1, 20.0});  // geometric means 3 and 1.4: honest, one would read
  add_rows(rows, "b", "pose_nees", {2.9, 3.0, 3.1, 3.2});
  add_rows(rows, "a", "pose_efficiency", {2.0, 8.0, 2.0, 8.0});
  add_rows(rows, "b", "pose_efficiency", {1.0, 1.0, 1.0, 1.0});
  const auto ranking = rank_pipelines(two_scenarios(), rows, spec);
  ASSERT_EQ(ranking[1].name, "a");
  EXPECT_NEAR(ranking[1].values.at("pose_nees").mean, (0.3 + 30.0 + 0.1 + 20.0) / 4.0, 1e-12);
  EXPECT_NEAR(ranking[1].values.at("pose_efficiency").mean, 4.0, 1e-12) << "a ratio has the geometric mean";
  EXPECT_NEAR(ranking[1].ranges.at("pose_nees").least, 0.2, 1e-12);  // x: the mean of 0.3 and 0.1
  EXPECT_NEAR(ranking[1].ranges.at("pose_nees").most, 25.0, 1e-12);
  EXPECT_THAT(to_html(ranking_table(ranking, spec)), HasSubstr("conditions 0.20 to 25.00"));
}

TEST(Benchmark, AveragesOverConditionsFirstAndOverSeedsThen) {
  const auto ranking = rank_pipelines(two_scenarios(), made_up_rows(), kSpec);
  ASSERT_EQ(ranking.size(), 3u);
  EXPECT_EQ(ranking[0].name, "b");
  EXPECT_EQ(ranking[1].name, "a");
  EXPECT_EQ(ranking[2].name, "c");
  EXPECT_NEAR(ranking[0].values.at("f1").mean, 0.85, 1e-12);  // 0.8 and 0.9
  EXPECT_NEAR(ranking[1].values.at("f1").mean, 0.8, 1e-12);
  EXPECT_NEAR(ranking[2].values.at("f1").mean, 0.35, 1e-12);
  EXPECT_EQ(ranking[0].values.at("f1").count, 2);
  EXPECT_NEAR(ranking[0].values.at("f1").low, 0.8, 1e-12);  // two seeds have a range
  EXPECT_NEAR(ranking[0].values.at("f1").high, 0.9, 1e-12);
  // Undefined in x/1: seed 1 has 0.01, seed 2 the mean of 0.03 and 0.05.
  EXPECT_NEAR(ranking[2].values.at("sigma_offset").mean, 0.025, 1e-12);
  EXPECT_EQ(ranking[0].values.at("sigma_offset").count, 0);
}

TEST(Benchmark, TimesAreGeometricMeansAndTheirRatiosArePaired) {
  const auto ranking = rank_pipelines(two_scenarios(), made_up_rows(), kSpec);
  EXPECT_NEAR(ranking[1].values.at("t_scan").mean, 4.0, 1e-12);     // sqrt(2 8) and sqrt(4 4)
  EXPECT_NEAR(ranking[0].values.at("t_scan").mean, 1.5, 1e-12);     // 1 and 2
  EXPECT_NEAR(ranking[0].values.at("t_ratio").mean, 0.375, 1e-12);  // sqrt(1/2 1/8) = 1/4 and sqrt(1/4 1) = 1/2
  EXPECT_NEAR(ranking[1].values.at("t_ratio").mean, 1.0, 1e-12);
  EXPECT_NEAR(ranking[2].values.at("t_ratio").mean, 2.0, 1e-12);
}

TEST(Benchmark, NeighboursInRankHaveAPairedDifference) {
  std::vector<runs::SummaryRow> rows;
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U, 6U})
    for (const char* scenario : {"x", "y"}) {
      // The mean of five equal differences and one that is larger by 0.6 has the standard error 0.1.
      rows.push_back({scenario, "b", seed, "f1", "all", seed == 6 ? 1.1 : 0.5, "", 10});
      rows.push_back({scenario, "a", seed, "f1", "all", 0.5, "", 10});
      rows.push_back({scenario, "c", seed, "f1", "all", seed == 6 ? -0.5 : 0.1, "", 10});
    }
  const auto ranking = rank_pipelines(two_scenarios(), rows, kSpec);
  // t(0.975, 5) = 2.5706 (tables of Student's t).
  EXPECT_NEAR(ranking[0].next.mean, 0.1, 1e-12);  // b - a
  EXPECT_NEAR(ranking[0].next.low, 0.1 - 2.5706 * 0.1, 1e-5);
  EXPECT_NEAR(ranking[1].next.mean, 0.5, 1e-12);  // a - c
  EXPECT_GE(ranking[1].next.high, 0.5 + 2.5706 * 0.1 - 1e-5) << "a bootstrap may be wider";
  EXPECT_EQ(ranking[2].next.count, 0);
  std::erase_if(rows, [](const runs::SummaryRow& row) { return row.seed == 6; });
  const auto few = rank_pipelines(two_scenarios(), rows, kSpec);
  EXPECT_EQ(few[1].next.low, few[1].next.high) << "five equal differences have a range, and it is a point";
}

TEST(Benchmark, CountsTheConditionsWon) {
  const auto ranking = rank_pipelines(two_scenarios(), made_up_rows(), kSpec);
  // x: a 0.85, b 0.85. y: a 0.75, b 0.85.
  EXPECT_EQ(ranking[0].conditions_won + ranking[1].conditions_won, 3);
  EXPECT_EQ(ranking[0].conditions_won, 2);
  EXPECT_EQ(ranking[2].conditions_won, 0);
}

TEST(Benchmark, APipelineWithMissingCellsComesLast) {
  auto rows = made_up_rows();
  std::erase_if(rows, [](const runs::SummaryRow& r) { return r.pipeline == "b" && r.scenario == "y" && r.seed == 2; });
  const auto ranking = rank_pipelines(two_scenarios(), rows, kSpec);
  EXPECT_EQ(ranking[2].name, "b");
  EXPECT_EQ(ranking[2].missing, 1);
  EXPECT_EQ(ranking[0].missing, 0);
}

TEST(Benchmark, TableMarksTheBestOfEveryColumn) {
  const Table table = ranking_table(rank_pipelines(two_scenarios(), made_up_rows(), kSpec), kSpec);
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_EQ(table.rows[0].heads, (std::vector<std::string>{"1", "b"}));
  ASSERT_EQ(table.columns.size(), table.rows[0].cells.size());
  EXPECT_EQ(table.columns[0].head, "F1 [%]");
  EXPECT_EQ(table.rows[0].cells[0].text, "85.00");
  EXPECT_THAT(table.rows[0].cells[0].spread, "80.00 to 90.00");
  EXPECT_TRUE(table.rows[0].cells[0].best);
  EXPECT_TRUE(table.rows[1].cells[0].best);  // as good in the first seed: not separated
  EXPECT_FALSE(table.rows[2].cells[0].best);
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    if (table.columns[c].head == "σ offset [cm]") {
      EXPECT_EQ(table.rows[0].cells[c].text, "–");
      EXPECT_EQ(table.rows[2].cells[c].text, "2.500");
      EXPECT_FALSE(table.rows[2].cells[c].best);  // nothing to compare with, and F1 is 50 points behind
    }
    if (table.columns[c].head == "time [µs]") {
      EXPECT_TRUE(table.rows[0].cells[c].best);  // 1.5 against 4, F1 within 5 points
    }
    if (table.columns[c].head == "F1 − next") {
      EXPECT_EQ(table.rows[0].cells[c].spread, "+0.00 to +10.00");  // b - a in seeds 1 and 2
    }
  }
}

TEST(Benchmark, TableMarksCostsOfExtractorsThatFindEnoughAndMissNoCell) {
  auto rows = made_up_rows();
  for (auto& r : rows)
    if (r.pipeline == "c" && r.metric == "t_scan") r.value = 0.001;  // the fastest by far, with an F1 of 0.35
  std::vector<runs::SummaryRow> more;
  add_rows(more, "a", "efficiency_offset", {1.2, 1.2, 1.2, 1.2});
  add_rows(more, "b", "efficiency_offset", {0.5, 0.5, 0.5, 0.5});
  rows.insert(rows.end(), more.begin(), more.end());
  const auto best_in = [&](const std::vector<runs::SummaryRow>& of, const std::string& head) {
    const Table table = ranking_table(rank_pipelines(two_scenarios(), of, kSpec), kSpec);
    std::vector<std::string> names;
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      for (const auto& r : table.rows)
        if (table.columns[c].head == head && r.cells[c].best) names.push_back(r.heads[1].substr(0, 1));
    return names;
  };
  EXPECT_THAT(best_in(rows, "time [µs]"), ::testing::ElementsAre("b"));
  EXPECT_THAT(best_in(rows, "offset / bound"), ::testing::ElementsAre("a"));  // 1.2 is nearer to 1 than 0.5
  std::erase_if(rows, [](const runs::SummaryRow& r) { return r.pipeline == "b" && r.scenario == "y" && r.seed == 2; });
  EXPECT_THAT(best_in(rows, "time [µs]"), ::testing::ElementsAre("a"));
}

TEST(Benchmark, FileOfTheRunReadsBack) {
  const support::TemporaryFolder folder;
  EXPECT_FALSE(runs::load_benchmark(folder.path()).has_value());
  folder.write("benchmark.json", study::benchmark_json(kSpec));
  const auto spec = runs::load_benchmark(folder.path());
  ASSERT_TRUE(spec.has_value());
  EXPECT_EQ(spec->about, "what");
  EXPECT_EQ(spec->baseline, "a");
  EXPECT_EQ(spec->example, "x");
  folder.write("benchmark.json", "{\"baseline\": 3}");
  EXPECT_THAT(support::config_refusal([&] { runs::load_benchmark(folder.path()); }), HasSubstr("benchmark.json"));
}

TEST(Benchmark, FileOfAnotherRunIsRefused) {
  const std::vector<study::Scenario> scenarios = two_scenarios();
  const auto refusal = [&](const study::BenchmarkSpec& spec) {
    const support::TemporaryFolder folder;
    folder.write("benchmark.json", study::benchmark_json(spec));
    return support::config_refusal([&] { runs::load_benchmark(folder.path(), scenarios); });
  };
  EXPECT_EQ(refusal(kSpec), "");
  study::BenchmarkSpec other = kSpec;
  other.of = "match";
  EXPECT_THAT(refusal(other), HasSubstr("benchmark.json is of another run: "));
  EXPECT_THAT(refusal(other), HasSubstr("has no slot match"));
  other = kSpec;
  other.baseline = "zoe";
  EXPECT_THAT(refusal(other), HasSubstr("no pipeline is called zoe; known: a, b, c"));
  other = kSpec;
  other.example = "z";
  EXPECT_THAT(refusal(other), HasSubstr("no scenario is called z"));
  other = kSpec;
  other.levels = {{"light", "day", {"x", "moon"}}};
  EXPECT_THAT(refusal(other), HasSubstr("no scenario is called moon"));
}

TEST(Benchmark, NamesTheBestAtEveryLevelOfAFactor) {
  const std::vector<std::string> names{"a", "b", "c"};
  auto rows = made_up_rows();
  for (auto& row : rows)  // night: a is 0.1 and 0.2 behind b
    if (row.pipeline == "a" && row.metric == "f1" && row.scenario == "x") row.value = row.seed == 1 ? 0.90 : 0.98;
  const auto results = results_by_level(two_scenarios(), rows, spec_with_levels(), names);
  ASSERT_EQ(results.size(), 3u);
  using ::testing::ElementsAre;
  EXPECT_THAT(results[0].leaders, ElementsAre(0));     // day: a 0.90 and 0.98, b 0.8 and 0.9, c less
  EXPECT_THAT(results[1].leaders, ElementsAre(1));     // night: a 0.7 and 0.8, b 0.8 and 0.9
  EXPECT_THAT(results[2].leaders, ElementsAre(1, 0));  // both: a 0.80 and 0.89, b 0.80 and 0.90
  EXPECT_NEAR(results[0].values[0].mean, 0.94, 1e-12);
  EXPECT_NEAR(results[1].values[2].mean, 0.25, 1e-12);
  EXPECT_NEAR(results[2].values[1].mean, 0.85, 1e-12);  // both
  const Table table = level_table(results, names, spec_with_levels());
  ASSERT_EQ(table.columns.size(), 3u);
  EXPECT_EQ(table.columns[1].group, "light");
  EXPECT_EQ(table.columns[1].head, "night");
  EXPECT_TRUE(table.rows[0].cells[0].best);
  EXPECT_FALSE(table.rows[1].cells[0].best);
  EXPECT_EQ(table.rows[1].cells[1].text, "85.00");
  const std::string text = best_by_level_text(results, names, spec_with_levels());
  EXPECT_THAT(text,
              HasSubstr("b has the best F1 at light night, place here; a at light day."));  // here: a 0.845, b 0.85
}

TEST(Benchmark, NamesAFactorOnceForAllOfItsLevels) {
  const std::vector<std::string> names{"a", "b"};
  std::vector<LevelResult> results;
  for (const char* level : {"1cm", "3cm"}) results.push_back({"noise", level, {}, {0, 1}});
  results.push_back({"sensor", "urg", {}, {0, 1}});
  results.push_back({"sensor", "pls", {}, {1}});
  EXPECT_EQ(best_by_level_text(results, names, kSpec),
            "a has the best F1 at noise 1cm / 3cm, sensor urg; b at sensor pls. The seeds do not separate the best "
            "from others at noise 1cm / 3cm, sensor urg; these have a star too.");
}

TEST(Benchmark, APipelineWithMissingCellsHasNoValueAtTheirLevel) {
  auto rows = made_up_rows();
  std::erase_if(rows, [](const runs::SummaryRow& r) { return r.pipeline == "b" && r.scenario == "y" && r.seed == 2; });
  const auto results = results_by_level(two_scenarios(), rows, spec_with_levels(), {"a", "b", "c"});
  ASSERT_EQ(results.size(), 3u);
  EXPECT_TRUE(std::isfinite(results[0].values[1].mean));
  EXPECT_TRUE(std::isnan(results[1].values[1].mean));
  EXPECT_EQ(results[1].leaders.front(), 0);
  EXPECT_EQ(level_table(results, {"a", "b", "c"}, spec_with_levels()).rows[1].cells[1].text, "–");
}

TEST(Benchmark, LevelsOfTheRunReadBack) {
  const support::TemporaryFolder folder;
  folder.write("benchmark.json", study::benchmark_json(spec_with_levels()));
  const auto spec = runs::load_benchmark(folder.path());
  ASSERT_TRUE(spec.has_value());
  ASSERT_EQ(spec->levels.size(), 3u);
  EXPECT_EQ(spec->levels[1].level, "night");
  EXPECT_EQ(spec->levels[2].scenarios, (std::vector<std::string>{"x", "y"}));
  folder.write("benchmark.json", R"({"about": "", "baseline": "a", "example": "x", "levels": [{"factor": 3}]})");
  EXPECT_THAT(support::config_refusal([&] { runs::load_benchmark(folder.path()); }), HasSubstr("benchmark.json"));
}

TEST(Benchmark, PageSaysWhatWasRunAndWhatItDoesNotShow) {
  ReportInput input;
  input.scenarios = two_scenarios();
  input.rows = made_up_rows();
  input.cells = {{"x", "a", 1, "ok", "", 0, 0}, {"x", "b", 1, "timeout", "after 3 s", 0, 0}};
  const Document document = page_of(input, kSpec);
  for (const std::string& page : {to_html(document), to_markdown(document)}) {
    EXPECT_THAT(page, HasSubstr("2 seeds are too few to say which of 3 extractors is best (at least 3); b has the "
                                "best F1 on them, 85.00 %."));
    EXPECT_THAT(page, HasSubstr("3 extractors on 2 conditions"));
    EXPECT_THAT(page, HasSubstr("2 seeds make 4 recordings with 40 scans"));
    EXPECT_THAT(page, HasSubstr("noise of 2 cm"));
    EXPECT_THAT(page, HasSubstr("Fewer than 6 seeds have no intervals."));
    EXPECT_THAT(page, HasSubstr("threshold_m 0.25"));
    EXPECT_THAT(page, HasSubstr("What it does not show"));
    EXPECT_THAT(page, HasSubstr("1 of 2 cells ok"));
    EXPECT_THAT(page, HasSubstr("after 3 s"));
  }
}

TEST(Benchmark, EveryColumnHasADefinitionThatStandsAlone) {
  for (const char* slot : {"extract", "match", "align"})
    for (const auto& column : study::benchmark_subject(slot).columns) {
      EXPECT_FALSE(column.definition.empty()) << column.head;
      EXPECT_FALSE(column.definition.starts_with("the same") || column.definition.starts_with("that "))
          << column.head << ": " << column.definition;
    }
}

TEST(Benchmark, PageShowsAllNumbersOfScansOfAWorld) {
  std::string longer = kScene;
  longer.replace(longer.find("scans: 4"), 8, "scans: 6");
  ReportInput input;
  input.scenarios = {study::parse_scenario(kScene, "x.yaml"), study::parse_scenario(longer, "y.yaml")};
  for (study::Scenario& scenario : input.scenarios) std::get<study::SimulatedInput>(scenario.input).world.name = "room";
  input.rows = made_up_rows();
  EXPECT_THAT(to_html(page_of(input, kSpec)), HasSubstr(">4, 6<"));
}

TEST(Benchmark, PageBeginsWithTheFirstInRankAndNamesMissingCells) {
  ReportInput input;
  input.scenarios = two_scenarios();
  input.rows = made_up_rows();
  std::erase_if(input.rows,
                [](const runs::SummaryRow& r) { return r.pipeline == "b" && r.scenario == "y" && r.seed == 2; });
  EXPECT_THAT(to_html(page_of(input, kSpec)), HasSubstr("a has the best F1 on them, 80.00 %"));
  std::erase_if(input.rows, [](const runs::SummaryRow& r) { return r.scenario == "y" && r.seed == 2; });
  EXPECT_THAT(to_html(page_of(input, kSpec)), HasSubstr("<p class=\"lead\">No extractor has a result in every cell"));
}

std::string matching_scene(const std::string& metrics) {
  return std::string(kScene).substr(0, std::string(kScene).find("pipelines")) + R"(pipelines:
  - {name: a, extract: {module: iepf}, match: {module: icp}}
  - {name: b, extract: {module: iepf}, match: {module: plicp}}
metrics: )" +
         metrics + "\n";
}

TEST(Benchmark, RanksMatchersByTheLowestErrorOverBound) {
  const std::string scene = matching_scene("[{name: pose_efficiency, params: {errors: true}}, trajectory, timing]");
  const std::vector<study::Scenario> scenarios{study::parse_scenario(scene, "x.yaml"),
                                               study::parse_scenario(scene, "y.yaml")};
  std::vector<runs::SummaryRow> rows;
  add_rows(rows, "a", "pose_efficiency", {4, 1, 8, 2});
  add_rows(rows, "b", "pose_efficiency", {2, 2, 1, 1});
  add_rows(rows, "a", "t_match", {2, 8, 4, 4});
  add_rows(rows, "b", "t_match", {1, 4, 8, 8});
  for (const char* name : {"a", "b"}) add_rows(rows, name, "pose_unmatched", {0, 0, 0, 0});
  const study::BenchmarkSpec spec{"what", "a", "x", "match"};
  const auto ranking = rank_pipelines(scenarios, rows, spec);
  ASSERT_EQ(ranking.size(), 2u);
  EXPECT_EQ(ranking[0].name, "b");
  EXPECT_NEAR(ranking[0].values.at("pose_efficiency").mean, 1.5, 1e-12);  // of 2 and 1
  EXPECT_NEAR(ranking[1].values.at("pose_efficiency").mean, 3.0, 1e-12);  // of 2 and 4, each a geometric mean
  EXPECT_NEAR(ranking[0].next.mean, 0.5 * (std::log(2.0 / 2.0) + std::log(1.0 / 4.0)), 1e-12);
  EXPECT_EQ(ranking[0].conditions_won, 2);  // y is a tie: both have the geometric mean of 2 and 1
  EXPECT_EQ(ranking[1].conditions_won, 1);
  EXPECT_NEAR(ranking[0].values.at("t_ratio").mean, 0.5 * (0.5 + 2.0), 1e-12);
  const Table table = ranking_table(ranking, spec);
  EXPECT_EQ(table.columns[0].head, "MSE / bound");
  EXPECT_TRUE(table.rows[0].cells[0].best);
  EXPECT_TRUE(table.rows[1].cells[0].best);  // 2 of both in the first seed: not separated
  ReportInput input;
  input.scenarios = scenarios;
  input.rows = rows;
  const std::string page = to_html(page_of(input, spec));
  EXPECT_THAT(page, HasSubstr("2 matchers on 2 conditions"));
  EXPECT_THAT(page, HasSubstr("The mean square error of b&#39;s poses is 1.5 times the Cramér–Rao bound, the best "
                              "possible."));
}

TEST(Benchmark, AFastMatcherThatErrsFarMoreThanTheBestHasNoMarkForItsTime) {
  const std::string scene = matching_scene("[{name: pose_efficiency, params: {errors: true}}, trajectory, timing]");
  const std::vector<study::Scenario> scenarios{study::parse_scenario(scene, "x.yaml"),
                                               study::parse_scenario(scene, "y.yaml")};
  for (const double ratio : {2.0, 2.1}) {  // at most twice the best takes part
    std::vector<runs::SummaryRow> rows;
    add_rows(rows, "a", "pose_efficiency", {ratio, ratio, ratio, ratio});
    add_rows(rows, "b", "pose_efficiency", {1, 1, 1, 1});
    add_rows(rows, "a", "t_match", {1, 1, 1, 1});
    add_rows(rows, "b", "t_match", {5, 5, 5, 5});
    for (const char* name : {"a", "b"}) add_rows(rows, name, "pose_unmatched", {0, 0, 0, 0});
    const study::BenchmarkSpec spec{"what", "a", "x", "match"};
    const Table table = ranking_table(rank_pipelines(scenarios, rows, spec), spec);
    const auto time = std::ranges::find(table.columns, "time / a", &TableColumn::head) - table.columns.begin();
    for (const auto column : {time - 1, time}) {
      EXPECT_EQ(table.rows[0].cells[static_cast<std::size_t>(column)].best, ratio > 2.0) << ratio;
      EXPECT_EQ(table.rows[1].cells[static_cast<std::size_t>(column)].best, ratio <= 2.0) << ratio;
    }
  }
}

TEST(Benchmark, AMatcherThatLeavesOutManyPairsHasNoMark) {
  const std::string scene = matching_scene("[{name: pose_efficiency, params: {errors: true}}, trajectory, timing]");
  const std::vector<study::Scenario> scenarios{study::parse_scenario(scene, "x.yaml"),
                                               study::parse_scenario(scene, "y.yaml")};
  std::vector<runs::SummaryRow> rows;
  add_rows(rows, "a", "pose_efficiency", {2, 2, 2, 2});
  add_rows(rows, "b", "pose_efficiency", {1, 1, 1, 1});
  add_rows(rows, "a", "pose_unmatched", {0.02, 0.02, 0.02, 0.02});
  add_rows(rows, "b", "pose_unmatched", {0.08, 0.08, 0.08, 0.08});
  const study::BenchmarkSpec spec{"what", "a", "x", "match"};
  const auto ranking = rank_pipelines(scenarios, rows, spec);
  const Table table = ranking_table(ranking, spec);
  EXPECT_EQ(ranking[0].name, "b");
  EXPECT_FALSE(table.rows[0].cells[0].best);
  EXPECT_TRUE(table.rows[1].cells[0].best);
}

TEST(Benchmark, OfMatchersNeedsMatchSlotsAndTheirMetrics) {
  const auto refusal = [](const std::string& scene, const std::string& text) {
    const std::vector<study::Scenario> scenarios{study::parse_scenario(scene, "x.yaml")};
    return support::config_refusal([&] { study::read_benchmark(io::parse_yaml(text), scenarios); });
  };
  const std::string good = matching_scene("[{name: pose_efficiency, params: {errors: true}}, trajectory, timing]");
  EXPECT_THAT(refusal(kScene, "{of: match, baseline: a}"), HasSubstr("has no slot match"));
  EXPECT_THAT(refusal(matching_scene("[pose_efficiency, trajectory, timing]"), "{of: match, baseline: a}"),
              HasSubstr("no metric pose_efficiency with errors"));
  EXPECT_THAT(refusal(good, "{of: poses, baseline: a}"), HasSubstr("extract"));
}

std::string aligning_scene(const std::string& metrics) {
  return std::string(kScene).substr(0, std::string(kScene).find("pipelines")) + R"(pipelines:
  - {name: a, extract: {module: iepf}, align: {module: ffs}}
  - {name: b, extract: {module: iepf}, align: {module: point_to_line}}
metrics: )" +
         metrics + "\n";
}

TEST(Benchmark, RanksAlignersByTheShareOfScansPlacedAndAnAlignerThatFailsLast) {
  const std::string scene = aligning_scene("[alignment, timing]");
  const std::vector<study::Scenario> scenarios{study::parse_scenario(scene, "x.yaml"),
                                               study::parse_scenario(scene, "y.yaml")};
  std::vector<runs::SummaryRow> rows;
  add_rows(rows, "a", "placed", {0.5, 1.0, 0.5, 1.0});
  add_rows(rows, "b", "placed", {1.0, 1.0, 1.0, 0.8});
  add_rows(rows, "a", "error_ratio", {0.1, 0.1, 0.1, 0.1});
  add_rows(rows, "b", "error_ratio", {0.5, 0.5, 0.5, 0.5});
  const study::BenchmarkSpec spec{"what", "a", "x", "align"};
  auto ranking = rank_pipelines(scenarios, rows, spec);
  ASSERT_EQ(ranking.size(), 2U);
  EXPECT_EQ(ranking[0].name, "b");
  EXPECT_NEAR(ranking[0].values.at("placed").mean, 0.95, 1e-12);
  const Table table = ranking_table(ranking, spec);
  EXPECT_EQ(table.columns[2].head, "error / start");
  EXPECT_FALSE(table.rows[1].cells[2].best) << "it errs less, but places 20 points fewer";
  ReportInput input;
  input.scenarios = scenarios;
  input.rows = rows;
  EXPECT_THAT(to_html(page_of(input, spec)), HasSubstr("b has the best scans placed on them, 95.0 %"));
  std::erase_if(rows, [](const runs::SummaryRow& r) { return r.pipeline == "b" && r.scenario == "y" && r.seed == 2; });
  EXPECT_EQ(rank_pipelines(scenarios, rows, spec)[0].name, "a");
}

TEST(Benchmark, OfAlignersNeedsAlignSlotsAndTheirMetric) {
  const auto refusal = [](const std::string& scene) {
    const std::vector<study::Scenario> scenarios{study::parse_scenario(scene, "x.yaml")};
    return support::config_refusal(
        [&] { study::read_benchmark(io::parse_yaml("{of: align, baseline: a}"), scenarios); });
  };
  EXPECT_EQ(refusal(aligning_scene("[alignment, timing]")), "");
  EXPECT_THAT(refusal(kScene), HasSubstr("has no slot align"));
  EXPECT_THAT(refusal(aligning_scene("[timing]")), HasSubstr("no metric alignment"));
}

TEST(ErrorBins, RootMeanSquareOfEverySeedAndTheirGeometricMean) {
  ErrorBins bins(1.0, 2.0);
  bins.add(1, 1.0, 3.0, 2.0);   // bin [1, 2)
  bins.add(1, 1.5, -4.0, 2.0);  // seed 1: mean square 12.5
  bins.add(2, 1.9, 5.0, 4.0);   // seed 2: 25
  bins.add(1, 0.7, 1.0, 1.0);   // bin [0.5, 1)
  bins.add(1, 2.0, 1.0, 1.0);   // bin [2, 4), too few
  bins.add(1, -1.0, 9.0, 1.0);
  bins.add(1, 1.2, std::nan(""), 1.0);
  bins.add(1, 1.2, 9.0, std::nan(""));
  EXPECT_EQ(bins.points(1).size(), 3u);
  const auto points = bins.points(2);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].count, 3);
  EXPECT_NEAR(points[0].x, (1.0 + 1.5 + 1.9) / 3, 1e-12);
  EXPECT_NEAR(points[0].rms, std::sqrt(std::sqrt(12.5) * 5.0), 1e-12);
  EXPECT_NEAR(points[0].bound, std::sqrt((4.0 + 4.0 + 16.0) / 3), 1e-12);
  // Logarithms of sqrt(12.5) and 5: their standard error is half of their difference, t(0.975, 1) = 12.7062.
  const double reach = 12.7062 * 0.5 * std::log(5.0 / std::sqrt(12.5));
  EXPECT_NEAR(std::log(points[0].high / points[0].rms), reach, 1e-4);
  EXPECT_NEAR(std::log(points[0].rms / points[0].low), reach, 1e-4);
}

}  // namespace
}  // namespace scanbench::results
