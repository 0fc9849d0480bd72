// Choice of trace rows, and their files.
#include "harness/runs/store/traces.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/results/figures/figures.hpp"
#include "harness/runs/execute/run_options.hpp"
#include "harness/study/scenario/figure_pipelines.hpp"
#include "harness/study/scenario/trace_choice.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::runs {
namespace {

struct ModeRow {
  static constexpr std::string_view kName = "mode";
  double a = 0.0;
  double b = 0.0;
  double c = 0.0;
  double d = 0.0;
  static constexpr auto columns() {
    return std::tuple{column("a", &ModeRow::a), column("b", &ModeRow::b), column("c", &ModeRow::c),
                      column("d", &ModeRow::d)};
  }
};

struct LineRow {
  static constexpr std::string_view kName = "line";
  int points = 0;
  static constexpr auto columns() { return std::tuple{column("points", &LineRow::points)}; }
};

struct EmptyRow {
  static constexpr std::string_view kName = "empty";
  static constexpr auto columns() { return std::tuple<>{}; }
};

TEST(TraceChoice, WantsTheNamedRowsOfASlotAndDistinguishesChoices) {
  const study::TraceChoice none, all{.all = true}, some{.names = {"merge.mode", "merge.line"}};
  EXPECT_TRUE(none.nothing());
  EXPECT_FALSE(none.wants("merge"));
  EXPECT_TRUE(all.wants("extract", "anything"));
  EXPECT_TRUE(some.wants("merge"));
  EXPECT_TRUE(some.wants("merge", "mode"));
  EXPECT_FALSE(some.wants("merge", "mod"));
  EXPECT_FALSE(some.wants("mer"));
  EXPECT_FALSE(some.wants("extract"));
  EXPECT_FALSE(some.wants("zebra"));
  EXPECT_EQ(some.text(), "merge.line merge.mode");
  EXPECT_NE(none.text(), all.text());
}

TEST(Trace, ComesBackFromItsFileWithEveryBit) {
  const support::TemporaryFolder folder;
  const double inf = std::numeric_limits<double>::infinity();
  Journal journal;
  Trace merge = journal.begin("merge", -1);
  merge.stage(Stage::phase1);
  merge.row(ModeRow{1.0 / 3.0, -1e-300, inf, -inf});
  merge.row(EmptyRow{});
  Trace extract = journal.begin("extract", 4);
  extract.row(LineRow{7});
  io::write_file_atomically(folder.path() / "trace.csv", journal.csv());
  const TraceRows rows = load_trace(folder.path(), {.all = true});
  ASSERT_EQ(rows.size(), 3u);
  ASSERT_EQ(rows.at("merge.mode").size(), 1u);
  EXPECT_EQ(rows.at("merge.mode")[0].values, (std::vector<double>{1.0 / 3.0, -1e-300, inf, -inf}));
  EXPECT_EQ(rows.at("merge.mode")[0].frame, -1);
  EXPECT_TRUE(rows.at("merge.empty")[0].values.empty());
  EXPECT_EQ(rows.at("extract.line")[0].frame, 4);
  EXPECT_EQ(load_trace(folder.path(), {.names = {"extract.line"}}).size(), 1u);
  EXPECT_TRUE(load_trace(folder.path(), {}).empty());
  EXPECT_TRUE(load_trace(folder.path() / "nowhere", {.all = true}).empty());
}

TEST(Trace, ADamagedFileIsRefusedWithItsLine) {
  const support::TemporaryFolder folder;
  io::write_file_atomically(folder.path() / "trace.csv",
                            "slot,frame,stage,name,values\nmerge,-1,a,mode,1 2\nmerge,-1,a,mode,1 x2\n");
  try {
    load_trace(folder.path(), {.all = true});
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("trace.csv:3"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("x2"));
  }
}

TEST(Journal, KeepsTheChosenRowsAndListensToNoOtherSlot) {
  Journal journal({.names = {"merge.mode"}});
  Trace extract = journal.begin("extract", 0);
  EXPECT_FALSE(extract.recording());
  extract.row(ModeRow{1, 1, 1, 1});
  Trace merge = journal.begin("merge", -1);
  EXPECT_TRUE(merge.recording());
  merge.row(ModeRow{2, 3, 4, 5});
  merge.row(LineRow{3});
  EXPECT_EQ(journal.csv(), "slot,frame,stage,name,values\nmerge,-1,,mode,2 3 4 5\n");
}

TEST(Runner, KeepsTheRowsThatTheFiguresDrawFromForTheFirstSeed) {
  const support::TemporaryFolder folder;
  const auto out = folder.path() / "r";
  std::vector<study::Scenario> scenarios{
      fixtures::scenario_with("s", {fixtures::extract_with("a", "test_line")}, {4, 2})};
  fixtures::run_here(scenarios, {.out = out});
  EXPECT_FALSE(std::filesystem::exists(out / "cells/s/a/4/trace.csv"));

  scenarios[0].figures = {{"figure", "test_traced", {}}};
  EXPECT_EQ(study::traces_drawn(scenarios[0], "a").text(), "extract.line");
  const RunResult result = fixtures::run_here(scenarios, {.out = out, .resume = true});
  EXPECT_FALSE(fixtures::cell_of(result, "s/a/4").reused);  // it had no trace
  EXPECT_TRUE(fixtures::cell_of(result, "s/a/2").reused);
  EXPECT_FALSE(std::filesystem::exists(out / "cells/s/a/2/trace.csv"));
  const TraceRows rows = load_trace(out / "cells/s/a/4", {.all = true});
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows.at("extract.line").size(), 5u);

  scenarios[0].input = study::RecordedInput{};  // these random scans have no world to show
  const auto drawn = results::draw_figures(RunStore(out), scenarios[0]);
  ASSERT_EQ(drawn.size(), 1u);
  EXPECT_THAT(drawn[0].caption, ::testing::StartsWith("5 rows of a"));
}

}  // namespace
}  // namespace scanbench::runs
