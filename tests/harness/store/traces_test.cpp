#include "harness/store/traces.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "harness/files/atomic_file.hpp"
#include "harness/report/figures.hpp"
#include "harness/run/run_options.hpp"
#include "harness/scenario/figure_pipelines.hpp"
#include "harness/scenario/trace_choice.hpp"
#include "tests/harness/run_support.hpp"

namespace scanbench::harness {
namespace {

TEST(TraceChoice, WantsTheNamedRowsOfASlotAndTellsChoicesApart) {
  const TraceChoice none, all{.all = true}, some{.names = {"merge.mode", "merge.line"}};
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
  const testing::TemporaryFolder folder;
  const double inf = std::numeric_limits<double>::infinity();
  Journal journal;
  journal.begin("merge", -1);
  journal.stage("phase1");
  journal.row("mode", {1.0 / 3.0, -1e-300, inf, -inf});
  journal.row("mode", {});
  journal.begin("extract", 4);
  journal.row("line", {7.0});
  write_file_atomically(folder.path() / "trace.csv", journal.csv());
  const TraceRows rows = load_trace(folder.path(), {.all = true});
  ASSERT_EQ(rows.size(), 2u);
  ASSERT_EQ(rows.at("merge.mode").size(), 2u);
  EXPECT_EQ(rows.at("merge.mode")[0].values, (std::vector<double>{1.0 / 3.0, -1e-300, inf, -inf}));
  EXPECT_EQ(rows.at("merge.mode")[0].frame, -1);
  EXPECT_TRUE(rows.at("merge.mode")[1].values.empty());
  EXPECT_EQ(rows.at("extract.line")[0].frame, 4);
  EXPECT_EQ(load_trace(folder.path(), {.names = {"extract.line"}}).size(), 1u);
  EXPECT_TRUE(load_trace(folder.path(), {}).empty());
  EXPECT_TRUE(load_trace(folder.path() / "nowhere", {.all = true}).empty());
}

TEST(Trace, ADamagedFileIsRefusedWithItsLine) {
  const testing::TemporaryFolder folder;
  write_file_atomically(folder.path() / "trace.csv",
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
  journal.begin("extract", 0);
  EXPECT_FALSE(journal.recording());
  journal.row("mode", {1.0});
  journal.begin("merge", -1);
  EXPECT_TRUE(journal.recording());
  journal.row("mode", {2.0});
  journal.row("other", {3.0});
  EXPECT_EQ(journal.csv(), "slot,frame,stage,name,values\nmerge,-1,,mode,2\n");
}

TEST(Runner, KeepsTheRowsThatTheFiguresDrawFromForTheFirstSeed) {
  const testing::TemporaryFolder folder;
  const auto out = folder.path() / "r";
  std::vector<Scenario> scenarios{testing::scenario_with("s", {testing::extract_with("a", "test_line")}, {4, 2})};
  testing::run_here(scenarios, {.out = out});
  EXPECT_FALSE(std::filesystem::exists(out / "cells/s/a/4/trace.csv"));

  scenarios[0].figures = {{"figure", "test_traced", {}}};
  EXPECT_EQ(traces_drawn(scenarios[0], "a").text(), "extract.line");
  const RunResult result = testing::run_here(scenarios, {.out = out, .resume = true});
  EXPECT_FALSE(testing::cell_of(result, "s/a/4").reused);  // it had no trace
  EXPECT_TRUE(testing::cell_of(result, "s/a/2").reused);
  EXPECT_FALSE(std::filesystem::exists(out / "cells/s/a/2/trace.csv"));
  const TraceRows rows = load_trace(out / "cells/s/a/4", {.all = true});
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows.at("extract.line").size(), 5u);

  scenarios[0].input = RecordedInput{};  // these random scans have no world to show
  const auto drawn = draw_figures(out, scenarios[0]);
  ASSERT_EQ(drawn.size(), 1u);
  EXPECT_EQ(drawn[0].caption, "5 rows of a");
}

}  // namespace
}  // namespace scanbench::harness
