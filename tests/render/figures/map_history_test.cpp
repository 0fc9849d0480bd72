// The figures of mappers: a map replayed from its trace, main directions, growth.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <variant>

#include "abcdef.hpp"
#include "core/contracts/map_trace.hpp"
#include "core/registry.hpp"
#include "render/figure.hpp"

namespace scanbench::render::test {
namespace {

template <TraceRowType Row>
void add(TraceRows& trace, int frame, const Row& row) {
  const auto values = values_of(row);
  trace[key_of<Row>("map")].push_back({frame, {values.begin(), values.end()}});
}

/// Line 0 is there from frame 0 on, becomes line 1 in frame 2; a second direction is adopted in frame 3.
TraceRows history() {
  TraceRows trace;
  add(trace, 0, mapping::BornRow{0, 0, 0, 4, 0});
  add(trace, 2, mapping::GoneRow{0});
  add(trace, 2, mapping::BornRow{1, 0, 1, 6, 1});
  for (int frame = 0; frame < 5; ++frame) {
    add(trace, frame, mapping::InsertionRow{.map_lines = 10 + frame});
    add(trace, frame, mapping::DirectionRow{0, 0.0, 4.0});
    if (frame >= 3) add(trace, frame, mapping::DirectionRow{1, radians(45), 2.0});
  }
  return trace;
}

std::vector<NamedScene> drawn(const std::string& figure, const TraceRows* trace, const ParamSet& params = {}) {
  const Recording recording = abcdef_recording(5);
  const PipelineResult result = lines_by_wall_id(recording, 0.0, true);
  FigureInput input{.title = "t", .recording = recording, .waypoints = {}, .results = {{"p", &result, trace}}};
  return Registry<Figure>::make(figure, params)->draw(input);
}

/// The segments of the map in a panel: its second item, above the true walls.
std::vector<Segment> map_of(const Panel& panel) {
  return std::get<Lines>(panel.items.at(1)).segments;
}

TEST(MainDirectionsFigure, ReplaysTheMapAtTheChosenMoments) {
  const TraceRows trace = history();
  const auto scenes = drawn("main_directions", &trace, {{"frames", std::vector<double>{0, 1, 2}}});
  ASSERT_EQ(scenes.size(), 2u);
  const auto& panels = scenes[0].scene.panels;
  ASSERT_EQ(panels.size(), 3u);
  for (const std::size_t before : {0u, 1u}) EXPECT_EQ(map_of(panels[before]), (std::vector<Segment>{{{0, 0}, {4, 0}}}));
  EXPECT_EQ(map_of(panels[2]), (std::vector<Segment>{{{0, 1}, {6, 1}}}));
}

TEST(MainDirectionsFigure, NamesTheScanThatAdoptsADirectionAndShowsTheOnesAroundIt) {
  const TraceRows trace = history();
  const auto scenes = drawn("main_directions", &trace);
  ASSERT_EQ(scenes.size(), 2u);
  EXPECT_THAT(scenes[0].caption, ::testing::HasSubstr("45.0 deg"));
  EXPECT_THAT(scenes[0].caption, ::testing::HasSubstr("adopted in scan 3"));
  EXPECT_THAT(scenes[0].scene.panels.at(1).title, ::testing::HasSubstr("scan 2: 0°"));
  EXPECT_THAT(scenes[0].scene.panels.at(2).title, ::testing::HasSubstr("scan 4: 0, 45°"));
}

TEST(MapGrowthFigure, DrawsTheLinesAfterEveryScan) {
  const TraceRows trace = history();
  const auto scenes = drawn("map_growth", &trace);
  ASSERT_EQ(scenes.size(), 1u);
  const auto& curve = std::get<Polyline>(scenes[0].scene.panels.at(0).items.at(0)).points;
  ASSERT_EQ(curve.size(), 5u);
  EXPECT_TRUE(curve[4] == Vec2(4, 14));
}

TEST(MapFigures, WithoutATraceThereIsNothingToShow) {
  for (const char* figure : {"main_directions", "map_growth"}) EXPECT_TRUE(drawn(figure, nullptr).empty()) << figure;
}

}  // namespace
}  // namespace scanbench::render::test
