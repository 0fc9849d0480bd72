// Lines instead of scans: files of lines, scenarios that begin with them, and whole runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/runs/execute/make_recording.hpp"
#include "harness/runs/execute/pipeline.hpp"
#include "harness/study/scenario/effective.hpp"
#include "harness/study/scenario/line_set.hpp"
#include "harness/study/scenario/scenario.hpp"
#include "harness/study/scenario/scenario_file.hpp"
#include "harness/study/scenario/suite.hpp"
#include "tests/support/inputs.hpp"

namespace scanbench::study {
namespace {

using testing::HasSubstr;

std::string refusal_of(const std::string& text) {
  return support::config_refusal([&] { parse_line_set(text, "mine.csv"); });
}

TEST(LineSet, ReadsColumnsInAnyOrderWithOrWithoutFrames) {
  const auto one = parse_line_set("y2_m x2_m y1_m x1_m\n4 3 2 1\n", "mine.csv");
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0], (std::vector<Segment>{{{1, 2}, {3, 4}}}));
  const auto two = parse_line_set(
      "# drawn by hand\nframe,x1_m,y1_m,x2_m,y2_m\n0,0,0,1,0\n0,0,1,1,1 # a remark\n\n1,5,5,6,7\n", "mine.csv");
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(two[0].size(), 2U);
  EXPECT_EQ(two[1], (std::vector<Segment>{{{5, 5}, {6, 7}}}));
}

TEST(LineSet, ReadsTheMapOfARun) {
  const auto lines = parse_line_set("line,x1_m,y1_m,x2_m,y2_m,members,points\n0,1,2,3,4,10,200\n", "map.csv");
  EXPECT_EQ(lines[0], (std::vector<Segment>{{{1, 2}, {3, 4}}}));
}

TEST(LineSet, RefusesWhatItCannotReadWithItsPlace) {
  const std::string head = "frame,x1_m,y1_m,x2_m,y2_m\n";
  EXPECT_THAT(refusal_of(""), HasSubstr("mine.csv:1:1: no line in 0 rows"));
  EXPECT_THAT(refusal_of(head), HasSubstr("no line in 1 rows"));
  EXPECT_THAT(refusal_of("x1_m,y1_m,x2_m\n"), HasSubstr("mine.csv:1:1: no column y2_m"));
  EXPECT_THAT(refusal_of("x1_m,y1_m,x2_m,y2_m,x1_m\n"), HasSubstr("two columns are called 'x1_m'"));
  EXPECT_THAT(refusal_of("x1_m,y1_m,x2_m,y2_m,colour\n"), HasSubstr("mine.csv:1:21: unknown column 'colour'"));
  EXPECT_THAT(refusal_of("1,2,3,4\n"), HasSubstr("mine.csv:1:1: unknown column '1'; allowed in the first row: x1_m"));
  EXPECT_THAT(refusal_of(head + "0,1,2,3\n"), HasSubstr("mine.csv:2:1: a row of 4 fields; allowed: 5"));
  EXPECT_THAT(refusal_of(head + "0,1,2,three,4\n"), HasSubstr("mine.csv:2:7: x2_m is 'three'; allowed: a number"));
  EXPECT_THAT(refusal_of(head + "0,1,nan,3,4\n"), HasSubstr("mine.csv:2:5: y1_m is 'nan'"));
  EXPECT_THAT(refusal_of(head + "0,1,2,1e10,4\n"), HasSubstr("mine.csv:2:7: x2_m is '1e10'; allowed: up to 1e9 m"));
  EXPECT_THAT(refusal_of(head + "0,1,2,1,2\n"), HasSubstr("mine.csv:2:3: a line without length"));
  EXPECT_THAT(refusal_of(head + "1,1,2,3,4\n"), HasSubstr("mine.csv:2:1: frame is '1'; allowed: 0, 1, 2"));
  EXPECT_THAT(refusal_of(head + "0,1,2,3,4\n2,1,2,3,4\n"), HasSubstr("mine.csv:3:1: frame is '2'"));
  EXPECT_THAT(refusal_of(head + "0,1,2,3,4\n1,1,2,3,4\n0,1,2,3,4\n"), HasSubstr("mine.csv:4:1: frame is '0'"));
  EXPECT_THAT(refusal_of(head + "0.5,1,2,3,4\n"), HasSubstr("frame is '0.5'"));
}

constexpr const char* kCopies = R"(schema: 1
world: {segments: [[a, 0, 0, 4, 0], [b, 0, 4, 4, 4]]}
lines: {copies: 6, shift_sigma_m: 0.01}
seeds: [1, 2]
pipelines: [{name: ms, merge: {module: mean_shift}}]
metrics: [map_points, map_truth]
)";

TEST(LinesScenario, CopiesWallsPerSeed) {
  const Scenario s = parse_scenario(kCopies, "x.yaml");
  EXPECT_TRUE(has_chance(s));
  EXPECT_EQ(s.seeds.size(), 2U);
  const Recording one = runs::make_recording(s, 1, 1);
  EXPECT_EQ(one.observed.frames.size(), 6U);
  EXPECT_EQ(one.truth->walls.size(), 2U);
  EXPECT_NE(one.observed.frames[0].odom_from_sensor, runs::make_recording(s, 2, 1).observed.frames[0].odom_from_sensor);
  EXPECT_EQ(runs::run_pipeline(s.pipelines[0], one.observed).result.map.lines.size(), 2U);
  EXPECT_EQ(support::config_refusal([&] { runs::check_scenario(s); }), "");
}

TEST(LinesScenario, HasAStableEffectiveForm) {
  const support::TemporaryFolder folder;
  folder.write("mine.csv", "x1_m y1_m x2_m y2_m\n0 0 1 0\n");
  for (const std::string& text :
       {std::string(kCopies), std::string("schema: 1\nlines: {file: mine.csv}\n"),
        std::string("schema: 1\nlines: {file: mine.csv}\nworld: {segments: [[a, 0, 0, 1, 0]]}\n")}) {
    const Scenario s = parse_scenario(text, folder.path() / "x.yaml");
    const std::string effective = effective_yaml(s);
    const Scenario again = parse_scenario(effective, "/elsewhere/effective.yaml");
    EXPECT_EQ(effective_yaml(again), effective);
    const Recording a = runs::make_recording(s, 1, 1);
    const Recording b = runs::make_recording(again, 1, 1);
    ASSERT_EQ(a.observed.frames.size(), b.observed.frames.size());
    EXPECT_EQ(a.observed.frames[0].lines, b.observed.frames[0].lines);
    EXPECT_EQ(a.truth.has_value(), text.find("world") != std::string::npos);
    EXPECT_EQ(a.truth.has_value(), b.truth.has_value());
  }
}

TEST(LinesScenario, OfAFileHasNoChanceInIt) {
  const support::TemporaryFolder folder;
  folder.write("mine.csv", "x1_m y1_m x2_m y2_m\n0 0 1 0\n");
  const Scenario s = parse_scenario("schema: 1\nlines: {file: mine.csv}\n", folder.path() / "x.yaml");
  EXPECT_FALSE(has_chance(s));
  folder.write("s.yaml", "schema: 1\nlines: {file: mine.csv}\npipelines: [{name: ms, merge: {module: mean_shift}}]\n");
  const auto suite = folder.write("suite.yaml",
                                  "schema: 1\nscenarios: [s.yaml]\nseeds: [4, 5]\n"
                                  "pipelines: [{name: chain, merge: {module: amigoni_chain}}]\n");
  const Suite loaded = load_suite(suite);
  EXPECT_EQ(loaded.scenarios[0].seeds, std::vector<std::uint64_t>{1});
  EXPECT_EQ(loaded.scenarios[0].pipelines[0].name, "chain");
}

}  // namespace
}  // namespace scanbench::study
