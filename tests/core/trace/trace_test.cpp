// Traces: a listener gets what is written, and rows are read as the structs that wrote them.
#include "core/trace/trace.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/trace/trace_rows.hpp"

namespace scanbench {
namespace {

using ::testing::ElementsAre;

struct StepRow {
  static constexpr std::string_view kName = "step";
  int step = 0;
  double length_m = 0.0;
  static constexpr auto columns() {
    return std::tuple{column("step", &StepRow::step), column("length_m", &StepRow::length_m)};
  }
};

struct OtherRow {
  static constexpr std::string_view kName = "other";
  double value = 0.0;
  static constexpr auto columns() { return std::tuple{column("value", &OtherRow::value)}; }
};

TEST(Trace, WithoutAListenerTakesEverythingAndRecordsNothing) {
  Trace silent;
  EXPECT_FALSE(silent.recording());
  silent.stage(Stage::pre);
  silent.row(StepRow{1, 2.0});
}

TEST(Trace, HandsStagesAndRowsWithTheirSchemaToItsListener) {
  std::vector<Stage> stages;
  std::vector<std::vector<double>> rows;
  TraceSchema last;
  Trace trace({.stage = [&](Stage begun) { stages.push_back(begun); },
               .row =
                   [&](const TraceSchema& schema, std::span<const double> values) {
                     last = schema;
                     rows.emplace_back(values.begin(), values.end());
                   }});
  EXPECT_TRUE(trace.recording());
  trace.stage(Stage::split);
  trace.row(StepRow{3, 0.5});
  trace.stage(Stage::fit);
  trace.row(OtherRow{NAN});
  EXPECT_THAT(stages, ElementsAre(Stage::split, Stage::fit));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_THAT(rows[0], ElementsAre(3.0, 0.5));
  EXPECT_TRUE(std::isnan(rows[1].at(0)));
  EXPECT_EQ(last.name, "other");
  EXPECT_THAT(last.columns, ElementsAre("value"));
}

TEST(Trace, AListenerToStagesAloneRecordsNoRows) {
  int stages = 0;
  Trace trace({.stage = [&](Stage) { ++stages; }});
  EXPECT_FALSE(trace.recording());
  trace.row(OtherRow{1.0});
  trace.stage(Stage::merge);
  EXPECT_EQ(stages, 1);
}

TEST(TraceRows, AreReadAsTheStructsThatWroteThem) {
  TraceRows rows;
  const auto values = values_of(StepRow{-1, 1.0 / 3.0});
  rows["merge.step"].push_back({-1, {values.begin(), values.end()}});
  rows["extract.step"].push_back({4, {7.0, 8.0}});
  const auto read = rows_of<StepRow>(rows, "merge");
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].step, -1);
  EXPECT_EQ(read[0].length_m, 1.0 / 3.0);
  EXPECT_TRUE(rows_of<OtherRow>(rows, "merge").empty());
}

TEST(TraceRows, ThatDoNotFitTheSchemaAreLeftOut) {
  EXPECT_TRUE(row_from<StepRow>(std::vector<double>{2.0, 0.1}));
  EXPECT_TRUE(row_from<StepRow>(std::vector<double>{2147483647.0, NAN}));
  for (const std::vector<double>& values : {std::vector<double>{},
                                            {1.0},
                                            {1.0, 2.0, 3.0},
                                            {0.5, 1.0},
                                            {NAN, 1.0},
                                            {INFINITY, 1.0},
                                            {1e300, 1.0},
                                            {-3e9, 1.0}})
    EXPECT_FALSE(row_from<StepRow>(values));
  const TraceRows rows{{"merge.step", {{-1, {1.0}}, {-1, {2.0, 3.0}}}}};
  ASSERT_EQ(rows_of<StepRow>(rows, "merge").size(), 1u);
  EXPECT_EQ(rows_of<StepRow>(rows, "merge")[0].step, 2);
}

}  // namespace
}  // namespace scanbench
