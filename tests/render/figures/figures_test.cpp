// Every registered figure on a simulated recording, on a log without truth, and on nothing. With SCANBENCH_FIGURE_DIR
// set, the files are left there to be looked at.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <set>
#include <tuple>

#include "abcdef.hpp"
#include "core/registry.hpp"
#include "merged.hpp"
#include "render/backends/cairo.hpp"
#include "render/backends/gl.hpp"
#include "render/figure.hpp"
#include "render/palette.hpp"

namespace scanbench::render {
namespace {

void keep(const std::string& name, const std::string& bytes) {
  if (const char* dir = std::getenv("SCANBENCH_FIGURE_DIR"); dir != nullptr)
    std::ofstream(std::string(dir) + "/" + name, std::ios::binary) << bytes;
}

struct Case {
  Recording recording;
  std::vector<PipelineResult> results;
  TraceRows trace = {};  ///< of the first pipeline
  FigureInput input(const NamedPoints& waypoints) const {
    FigureInput in{.title = "abcdef", .recording = recording, .waypoints = waypoints, .results = {}};
    const std::vector<std::string> names{"iepf", "line_tracking", "smf", "ransac", "hough"};
    for (std::size_t i = 0; i < results.size(); ++i) {
      in.results.push_back({names[i], &results[i], i == 0 ? &trace : nullptr});
      in.measured.push_back({.pipeline = names[i],
                             .slots = {{"extract some", {{"threshold_m", 0.1 * static_cast<double>(i)}}}},
                             .units = {{"extract.threshold_m", "m"}},
                             .metrics = {{"f1", {0.8, 0.9 + 0.01 * static_cast<double>(i)}}}});
    }
    return in;
  }
};

Case simulated(int frames) {
  Case c{test::abcdef_recording(frames), {}};
  for (const double jitter : {0.01, 0.03, 0.06})
    c.results.push_back(test::lines_by_wall_id(c.recording, jitter, jitter != 0.03));
  c.trace = test::merged_by_mean_shift(c.recording, c.results[0]).trace;
  return c;
}

TEST(Figures, AllAreDrawnForASimulatedRecordingAndTheSvgStaysBelowAMegabyte) {
  const Case c = simulated(200);
  for (const std::string& name : Registry<Figure>::names()) {
    const std::vector<NamedScene> scenes = Registry<Figure>::make(name)->draw(c.input(test::abcdef_waypoints()));
    ASSERT_EQ(scenes.size(), 1u) << name;
    EXPECT_EQ(scenes[0].name, name);
    EXPECT_FALSE(scenes[0].caption.empty());
    const std::string svg = to_svg(scenes[0].scene);
    EXPECT_LT(svg.size(), 1'000'000u) << name;
    keep(name + ".svg", svg);
    keep(name + ".png", to_png(scenes[0].scene));
    keep(name + ".pdf", to_pdf(scenes[0].scene));
  }
}

TEST(Figures, WorkWithoutTruthAndWithOdometryOnly) {
  Case c = simulated(20);
  c.recording.truth.reset();
  for (const std::string& name : Registry<Figure>::names()) {
    const std::vector<NamedScene> scenes = Registry<Figure>::make(name)->draw(c.input({}));
    ASSERT_EQ(scenes.size(), 1u) << name;
    keep(name + "_log.png", to_png(scenes[0].scene));
  }
}

TEST(Figures, OfAnEmptyRecordingAreNone) {
  const Case c;
  for (const std::string& name : Registry<Figure>::names())
    EXPECT_TRUE(Registry<Figure>::make(name)->draw(c.input({})).empty()) << name;
}

TEST(Figures, OfScansWithoutAnyReturnAreDrawnAllTheSame) {
  Case c = simulated(3);
  for (Frame& frame : c.recording.observed.frames)
    for (double& range : frame.ranges) range = INFINITY;
  c.recording.truth.reset();
  c.results = std::vector<PipelineResult>(2);
  for (const std::string& name : Registry<Figure>::names())
    for (const NamedScene& scene : Registry<Figure>::make(name)->draw(c.input({})))
      EXPECT_FALSE(to_svg(scene.scene).empty());
}

TEST(ScanOverlay, ShowsTheFrameAskedForAndOnePanelPerPipelineInTheMethodsColour) {
  const Case c = simulated(9);
  const auto scenes = Registry<Figure>::make("scan_overlay", {{"frame", std::int64_t{7}}})->draw(c.input({}));
  ASSERT_EQ(scenes.size(), 1u);
  EXPECT_NE(scenes[0].scene.title.find("scan 8 of 9"), std::string::npos);
  ASSERT_EQ(scenes[0].scene.panels.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    std::size_t found = 0;
    for (const Item& item : scenes[0].scene.panels[i].items)
      if (const Lines* lines = std::get_if<Lines>(&item);
          lines != nullptr && lines->stroke.color == method_style(i).color) {
        ++found;
        ASSERT_EQ(lines->segments.size(), c.results[i].lines[7].lines.size());
        for (std::size_t k = 0; k < lines->segments.size(); ++k)
          EXPECT_EQ(lines->segments[k], c.results[i].lines[7].lines[k].segment);
      }
    EXPECT_EQ(found, 1u);
  }
}

TEST(Environment, DrawsAWayOnlyWhereThereIsOneAndRoundThingsWhereTheyStand) {
  const Case c = simulated(9);
  for (const bool continuous : {true, false}) {
    FigureInput input = c.input({});
    input.continuous = continuous;
    input.round_things = {{Vec2(2, 3), 0.5}};
    const auto scenes = Registry<Figure>::make("environment")->draw(input);
    std::size_t ways = 0, circles = 0;
    for (const Item& item : scenes.at(0).scene.panels.at(0).items)
      if (const Polyline* line = std::get_if<Polyline>(&item)) {
        ways += line->points.size() == 9 ? 1 : 0;
        if (!line->closed) continue;
        ++circles;
        for (const Vec2& p : line->points) EXPECT_NEAR((p - Vec2(2, 3)).norm(), 0.5, 1e-12);
      }
    EXPECT_EQ(ways, continuous ? 1U : 0U);
    EXPECT_EQ(circles, 1U);
  }
}

// Whatever the number from which on there are none.
TEST(Environment, SpeaksOfLabelsOnlyWhereTheyAreDrawn) {
  const Case c = simulated(3);
  const auto labels_drawn = [](const NamedScene& scene) {
    return std::ranges::any_of(scene.scene.panels.at(0).items,
                               [](const Item& item) { return std::holds_alternative<Text>(item); });
  };
  std::set<bool> seen;
  for (const std::size_t copies : {1U, 100U}) {
    Recording many = c.recording;
    for (std::size_t k = 1; k < copies; ++k)
      many.truth->walls.insert(many.truth->walls.end(), c.recording.truth->walls.begin(),
                               c.recording.truth->walls.end());
    const FigureInput crowded{.title = "t", .recording = many, .waypoints = {}, .results = {}};
    const auto scenes = Registry<Figure>::make("environment")->draw(crowded);
    ASSERT_EQ(scenes.size(), 1U);
    const bool drawn = labels_drawn(scenes[0]);
    seen.insert(drawn);
    EXPECT_EQ(scenes[0].caption.find("label") != std::string::npos, drawn) << scenes[0].caption;
    EXPECT_NE(scenes[0].caption.find("walls"), std::string::npos);
  }
  EXPECT_EQ(seen.size(), 2U);
}

TEST(LinesWorld, PlacesLinesByThePosesOfThePipelineIfThereAreAnyElseByTrueOnes) {
  Case c = simulated(2);
  const Pose2 moved(100, 0, 0);
  for (const Pose2& pose : c.recording.truth->world_from_sensor) c.results[0].world_from_sensor.push_back(moved * pose);
  const auto scenes = Registry<Figure>::make("lines_world")->draw(c.input({}));
  const auto first = [&](std::size_t panel) {
    for (const Item& item : scenes[0].scene.panels[panel].items)
      if (const Lines* lines = std::get_if<Lines>(&item)) return lines->segments.at(0);
    return Segment{};
  };
  const Pose2 true_pose = c.recording.truth->world_from_sensor[0];
  EXPECT_EQ(first(0), (moved * true_pose) * c.results[0].lines[0].lines[0].segment);
  EXPECT_EQ(first(1), true_pose * c.results[1].lines[0].lines[0].segment);
  EXPECT_NE(scenes[0].scene.panels[0].title.find("as aligned"), std::string::npos);
  EXPECT_NE(scenes[0].scene.panels[1].title.find("true poses"), std::string::npos);
}

TEST(Map, HasAPanelForEachPipelineWithAMapAndKeepsItsColour) {
  const auto scenes = Registry<Figure>::make("map")->draw(simulated(5).input({}));
  ASSERT_EQ(scenes.size(), 1u);
  ASSERT_EQ(scenes[0].scene.panels.size(), 2u);  // the second of three has none
  EXPECT_EQ(std::get<Lines>(scenes[0].scene.panels[1].items[1]).stroke.color, method_style(2).color);
}

// Few maps have a colour each, many share one.
TEST(Map, HasTheColoursOfItsPanelsInItsLegend) {
  for (const std::size_t pipelines : {1U, 3U, 5U}) {
    Case c = simulated(3);
    c.results.resize(pipelines, c.results[0]);
    const auto scenes = Registry<Figure>::make("map")->draw(c.input({}));
    ASSERT_EQ(scenes.size(), 1U);
    std::set<std::tuple<int, int, int>> drawn, named;
    for (const Panel& panel : scenes[0].scene.panels) {
      const Color color = std::get<Lines>(panel.items[1]).stroke.color;
      drawn.emplace(color.r, color.g, color.b);
    }
    for (const LegendEntry& entry : scenes[0].scene.legend)
      if (entry.text.find("map") != std::string::npos)
        named.emplace(entry.stroke->color.r, entry.stroke->color.g, entry.stroke->color.b);
    EXPECT_EQ(named, drawn) << pipelines;
    EXPECT_EQ(drawn.size(), pipelines == 3 ? 2U : 1U);  // the second of three has no map
  }
}

// Three widths of one method in any order, one pipeline of another, and one without a value.
TEST(Sweep, DrawsTheMeanAndTheBandOfPipelinesThatDifferInOneParameter) {
  const Recording none;
  FigureInput input{.title = "t", .recording = none, .waypoints = {}, .results = {}};
  const auto add = [&](const std::string& name, const std::string& slot, double x, std::vector<double> values) {
    input.measured.push_back(
        {.pipeline = name, .slots = {{slot, {{"x", x}, {"k", 1.0}}}}, .units = {{"merge.x", "m"}}, .metrics = {}});
    if (!values.empty()) input.measured.back().metrics["n"] = std::move(values);
  };
  add("wide_20", "merge a", 20, {1, 2, 6});
  add("wide_05", "merge a", 5, {4});
  add("wide_10", "merge a", 10, {7, 9});
  add("lonely", "merge b", 3, {5});
  add("mute", "merge a", 30, {});
  const auto scenes =
      Registry<Figure>::make("sweep", {{"parameters", std::string("merge.x, merge.y")}, {"metric", std::string("n")}})
          ->draw(input);
  ASSERT_EQ(scenes.size(), 1U);
  ASSERT_EQ(scenes[0].scene.panels.size(), 1U);  // nobody has a y
  const Panel& panel = scenes[0].scene.panels[0];
  EXPECT_EQ(panel.x.label, "merge.x [m]");
  EXPECT_EQ(std::get<Polygon>(panel.items.at(0)).points,
            (std::vector<Vec2>{{5, 4}, {10, 7}, {20, 1}, {20, 6}, {10, 9}, {5, 4}}));
  EXPECT_EQ(std::get<Polyline>(panel.items.at(1)).points, (std::vector<Vec2>{{5, 4}, {10, 8}, {20, 3}}));
  EXPECT_EQ(scenes[0].scene.legend.at(0).text, "wide");
}

}  // namespace
}  // namespace scanbench::render
