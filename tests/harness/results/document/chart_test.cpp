// Charts and sketches of pages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/special_values.hpp"
#include "harness/results/document/scan_sketch.hpp"
#include "harness/results/document/scatter_chart.hpp"
#include "harness/results/document/sparkline.hpp"

namespace scanbench::results {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(ScatterChart, HasAPointANameAndAHintForEveryFinitePoint) {
  const ScatterChart chart{
      "time [ms]", "f1", {{1.0, 0.9, "slow", false}, {0.1, 0.5, "fast", true}, {kNaN, 0.5, "lost", false}}};
  const std::string svg = scatter_chart(chart);
  EXPECT_THAT(svg, HasSubstr("<title>slow: 1, 0.9</title>"));
  EXPECT_THAT(svg, HasSubstr(">fast</text>"));
  EXPECT_THAT(svg, HasSubstr("class=\"front\""));
  EXPECT_THAT(svg, Not(HasSubstr("lost")));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(ScatterChart, SaysHowManyNamesHaveNoRoom) {
  ScatterChart chart{"t", "y", {}};
  for (int k = 0; k < 40; ++k)
    chart.points.push_back({1.0 + 0.001 * k, 0.5, "a_long_name_" + std::to_string(k), false});
  chart.points.push_back({100.0, 0.9, "apart", false});
  const std::string svg = scatter_chart(chart);
  std::size_t named = 0;
  for (std::size_t at = svg.find(">a_long_name_"); at != std::string::npos; at = svg.find(">a_long_name_", at + 1))
    named += svg.compare(at - 7, 7, "<title>") == 0 ? 0 : 1;
  named -= 40;  // the hints
  EXPECT_THAT(svg, HasSubstr(std::to_string(40 - named) + " names have no room"));
  EXPECT_THAT(scatter_chart({"t", "y", {{1.0, 1.0, "a", false}}}), Not(HasSubstr("no room")));
}

TEST(ScatterChart, NamesAPointOfTheFrontInACornerBelowAnother) {
  // In the lower left corner there is room to the right and below alone.
  const ScatterChart chart{
      "t", "y", {{1.0, 0.10, "mean_shift_060", true}, {1.4, 0.11, "chain_20", false}, {4.0, 0.9, "greedy", true}}};
  EXPECT_THAT(scatter_chart(chart), HasSubstr(">mean_shift_060</text>"));
}

TEST(ScatterChart, EscapesNamesAndIsEmptyWithoutPoints) {
  EXPECT_THAT(scatter_chart({"t", "y", {{1.0, 1.0, "<script>", false}}}), Not(HasSubstr("<script>")));
  EXPECT_THAT(scatter_chart({"t", "y", {{0.0, 1.0, "a", false}, {1.0, kInf, "b", false}}}), IsEmpty());
}

TEST(ScatterChart, OfEqualPointsStillHasAnAxis) {
  EXPECT_THAT(scatter_chart({"t", "y", {{1.0, 0.0, "a", true}, {1.0, 0.0, "b", true}}}), Not(HasSubstr("nan")));
}

TEST(ScanSketch, KeepsTheShapeAndDrawsEveryKindOfLineInItsClass) {
  ScanSketch sketch;
  sketch.points = {{4, 3}, {kNaN, 1}};
  sketch.lines = {{{{0, 3}, {4, 3}}, SketchLine::right},
                  {{{1, 1}, {2, 1}}, SketchLine::too_small},
                  {{{4, 0}, {4, 3}}, SketchLine::missed}};
  const std::string svg = scan_sketch(sketch);
  // 4 m by 3 m from the sensor at the lower left corner fill 452 x 332 of 480 x 360: the height decides the scale.
  EXPECT_THAT(svg, HasSubstr("class=\"right\" d=\"M19 14L461 14\""));
  EXPECT_THAT(svg, HasSubstr("class=\"small\" d=\""));
  EXPECT_THAT(svg, HasSubstr("class=\"missed\" d=\"M461 346L461 14\""));
  EXPECT_THAT(svg, HasSubstr("class=\"points\" d=\"M461 14h0\""));
  EXPECT_THAT(svg, HasSubstr("M19 346m"));  // the sensor
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(Sparkline, HasAGapWhereAValueIsNotDefined) {
  const std::vector<double> values{1.0, kNaN, 2.0};
  EXPECT_THAT(sparkline(values, "f1"), HasSubstr("M3.0 21.0M117.0 3.0"));
}

}  // namespace
}  // namespace scanbench::results
