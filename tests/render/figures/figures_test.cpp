// Every registered figure on a simulated recording, on a log without truth, and on nothing. With SCANBENCH_FIGURE_DIR
// set, the files are written there.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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
#include "render/figures/parts/view_box.hpp"
#include "render/layout/layout.hpp"
#include "render/palette.hpp"

namespace scanbench::render {
namespace {

void keep(const std::string& name, const std::string& bytes) {
  if (const char* dir = std::getenv("SCANBENCH_FIGURE_DIR"); dir != nullptr)
    std::ofstream(std::string(dir) + "/" + name, std::ios::binary) << bytes;
}

const std::vector<std::string> kNames{"iepf", "line_tracking", "smf", "ransac", "hough"};

/// The first five lines of a scan are right, split, false, unjudged and too small, and one true line is missed.
std::vector<ScanVerdict> some_verdicts(const PipelineResult& result) {
  std::vector<ScanVerdict> verdicts(result.lines.size());
  for (std::size_t f = 0; f < verdicts.size(); ++f) {
    for (std::size_t k = 0; k < result.lines[f].lines.size(); ++k)
      verdicts[f].lines.push_back(k < 5 ? static_cast<LineVerdict>(k) : LineVerdict::right);
    verdicts[f].missed.push_back({{1, 1}, {2, 1}});
  }
  return verdicts;
}

/// Half of the walls are found, one line is false.
PixelDifference some_difference(const Truth& truth) {
  PixelDifference difference{.right_pixels = 900, .wrong_pixels = 50, .missed_pixels = 70, .pixel_m = 0.01};
  difference.tolerance_m = 0.05;
  for (std::size_t w = 0; w < truth.walls.size(); ++w)
    (w % 2 == 0 ? difference.right : difference.missed).push_back(truth.walls[w].segment);
  difference.wrong.push_back({{2, 2}, {5, 4}});
  return difference;
}

struct Case {
  Recording recording;
  std::vector<PipelineResult> results;
  TraceRows trace = {};  ///< of the first pipeline
  FigureInput input(const NamedPoints& waypoints) const {
    FigureInput in{.title = "abcdef", .recording = recording, .waypoints = waypoints, .results = {}};
    for (std::size_t i = 0; i < results.size(); ++i) {
      in.results.push_back({kNames[i], &results[i], i == 0 ? &trace : nullptr});
      if (recording.truth) in.results.back().difference = some_difference(*recording.truth);
      MeasuredPipeline measured{.pipeline = kNames[i],
                                .slots = {{"extract some", {{"threshold_m", 0.1 * static_cast<double>(i)}}}},
                                .units = {{"extract.threshold_m", "m"}},
                                .metrics = {}};
      const double better = 0.01 * static_cast<double>(i);
      for (const auto& [metric, value] : {std::pair("f1", 0.9), std::pair("precision", 0.8), std::pair("recall", 0.7)})
        measured.metrics[metric] = {value - 0.1, value + better};
      measured.metrics["scan_time"] = {1e-5, 2e-5 + 5e-6 * static_cast<double>(i)};
      measured.by_seed = measured.metrics;
      for (const auto& [metric, values] : measured.metrics)
        measured.bands[metric] = {0.5 * (values[0] + values[1]), values[0], values[1]};
      in.measured.push_back(std::move(measured));
    }
    in.looks = {{"f1", {.best = MetricLook::Best::highest}},
                {"scan_time", {.label = "CPU time of one scan", .unit = "s", .best = MetricLook::Best::lowest}}};
    in.quality = "f1";
    if (!in.measured.empty()) in.scenarios = {{"abcdef", in.measured}};
    return in;
  }
};

Case simulated(int frames) {
  Case c{test::abcdef_recording(frames), {}};
  for (const double jitter : {0.01, 0.03, 0.06})
    c.results.push_back(test::lines_by_wall_id(c.recording, jitter, jitter != 0.03));
  for (PipelineResult& result : c.results)
    for (std::size_t k = 1; k < c.recording.observed.frames.size(); ++k) {
      const auto& poses = c.recording.truth->world_from_sensor;
      const Pose2 error(0.01 * std::sin(static_cast<double>(k)), 0.02 * std::cos(3.0 * static_cast<double>(k)), 0);
      FrameMatch match{.frame = static_cast<int>(k), .reference = static_cast<int>(k) - 1, .match = {}};
      match.match.reference_from_current = error * (poses[k - 1].inverse() * poses[k]);
      match.match.covariance = Eigen::Matrix3d(Eigen::Vector3d(1e-4, 4e-4, 1e-6).asDiagonal());
      result.matches.push_back(match);
    }
  c.trace = test::merged_by_mean_shift(c.recording, c.results[0]).trace;
  return c;
}

// They show how a map grows, or estimated poses; map_history_test.cpp and statistics_test.cpp draw them. Here no
// pipeline has a mapper or poses.
const std::set<std::string> kNeedMore = {"main_directions", "map_growth", "trajectory_error"};
const std::set<std::string> kNeedTruth = {"difference", "error_ellipses"};

TEST(Figures, AllAreDrawnForASimulatedRecordingAndTheSvgStaysBelowAMegabyte) {
  const Case c = simulated(200);
  for (const std::string& name : Registry<Figure>::names()) {
    const std::vector<NamedScene> scenes = Registry<Figure>::make(name)->draw(c.input(test::abcdef_waypoints()));
    if (kNeedMore.contains(name)) continue;
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
    if (kNeedMore.contains(name)) continue;
    if (kNeedTruth.contains(name)) {
      EXPECT_TRUE(scenes.empty()) << name;
      continue;
    }
    ASSERT_EQ(scenes.size(), 1u) << name;
    keep(name + "_log.png", to_png(scenes[0].scene));
  }
}

TEST(Difference, CountsPixelsAndDrawsThreeKindsOfParts) {
  const Case c = simulated(3);
  const FigureInput input = c.input({});
  const Scene scene = Registry<Figure>::make("difference")->draw(input).at(0).scene;
  ASSERT_EQ(scene.panels.size(), 3u);
  EXPECT_EQ(scene.panels[0].title, "iepf: 900 true, 70 missed, 50 false");
  EXPECT_TRUE(scene.scale_bar);
  for (const auto& [text, parts] : {std::pair("found and true", &input.results[0].difference->right),
                                    std::pair("missed", &input.results[0].difference->missed),
                                    std::pair("false", &input.results[0].difference->wrong)}) {
    const auto entry = std::ranges::find(scene.legend, text, &LegendEntry::text);
    ASSERT_NE(entry, scene.legend.end()) << text;
    EXPECT_TRUE(std::ranges::any_of(scene.panels[0].items, [&](const Item& item) {
      const auto* lines = std::get_if<Lines>(&item);
      return lines != nullptr && lines->stroke.color == entry->stroke->color && lines->segments == *parts;
    })) << text;
  }
}

TEST(Figures, OfAnEmptyRecordingAreNone) {
  const Case c;
  for (const std::string& name : Registry<Figure>::names())
    EXPECT_TRUE(Registry<Figure>::make(name)->draw(c.input({})).empty()) << name;
}

TEST(Figures, OfScansWithoutAnyReturnAreStillDrawn) {
  Case c = simulated(3);
  for (Frame& frame : c.recording.observed.frames)
    for (double& range : frame.ranges) range = INFINITY;
  c.recording.truth.reset();
  c.results = std::vector<PipelineResult>(2);
  for (const std::string& name : Registry<Figure>::names())
    for (const NamedScene& scene : Registry<Figure>::make(name)->draw(c.input({})))
      EXPECT_FALSE(to_svg(scene.scene).empty());
}

TEST(ScanOverlay, ShowsTheRequestedFrameAndOnePanelPerPipelineInTheMethodsColour) {
  const Case c = simulated(9);
  const auto scenes = Registry<Figure>::make("scan_overlay", {{"frame", std::int64_t{7}}})->draw(c.input({}));
  ASSERT_EQ(scenes.size(), 1u);
  EXPECT_NE(scenes[0].scene.title.find("scan 7 (0 to 8)"), std::string::npos);
  ASSERT_EQ(scenes[0].scene.panels.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    std::size_t found = 0;
    for (const Item& item : scenes[0].scene.panels[i].items)
      if (const Lines* lines = std::get_if<Lines>(&item);
          lines != nullptr && lines->stroke.color == method_style(kNames[i]).color) {
        ++found;
        ASSERT_EQ(lines->segments.size(), c.results[i].lines[7].lines.size());
        for (std::size_t k = 0; k < lines->segments.size(); ++k)
          EXPECT_EQ(lines->segments[k], c.results[i].lines[7].lines[k].segment);
      }
    EXPECT_EQ(found, 1u);
  }
}

TEST(Environment, DrawsAPathOnlyIfThereIsOneAndCirclesAtTheirPlaces) {
  const Case c = simulated(9);
  for (const bool continuous : {true, false}) {
    FigureInput input = c.input({});
    input.continuous = continuous;
    input.circles = {{Vec2(2, 3), 0.5}};
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

// For any number of walls beyond which there are none.
TEST(Environment, MentionsLabelsOnlyWhereTheyAreDrawn) {
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
  Case c = simulated(5);
  c.results[2].map.lines.pop_back();  // another map than the first one
  const auto scenes = Registry<Figure>::make("map")->draw(c.input({}));
  ASSERT_EQ(scenes.size(), 1u);
  ASSERT_EQ(scenes[0].scene.panels.size(), 2u);  // the second of three has none
  EXPECT_EQ(std::get<Lines>(scenes[0].scene.panels[1].items[1]).stroke.color, method_style(kNames[2]).color);
}

TEST(Map, HasTheColoursOfItsPanelsInItsLegend) {
  Case c = simulated(3);
  c.results[2].map.lines.pop_back();
  const auto scenes = Registry<Figure>::make("map")->draw(c.input({}));
  ASSERT_EQ(scenes.size(), 1U);
  for (const std::size_t i : {0U, 2U})
    EXPECT_TRUE(std::ranges::any_of(scenes[0].scene.legend, [&](const LegendEntry& entry) {
      return entry.text == kNames[i] && entry.stroke->color == method_style(kNames[i]).color;
    })) << kNames[i];
}

TEST(Map, NamesPointsOnlyIfItsLinesDoNotCoverThem) {
  for (const double beside_m : {0.0, 0.3}) {
    Case c;
    c.recording.observed.sensor.geometry = ScanGeometry(radians(-45), radians(1), 91);
    std::vector<double> ranges;
    for (int deg = -45; deg <= 45; ++deg)
      ranges.push_back((4.0 + (deg % 3 == 0 ? beside_m : 0.0)) / std::cos(radians(deg)));
    c.recording.observed.frames.push_back({0.0, ranges, Pose2()});
    PipelineResult result;
    result.has_map = true;
    result.map.lines.push_back({.segment = {{4, -4}, {4, 4}}});
    c.results = {result};
    const Scene scene = Registry<Figure>::make("map")->draw(c.input({})).at(0).scene;
    const bool named = std::ranges::find(scene.legend, "points of all scans", &LegendEntry::text) != scene.legend.end();
    const bool drawn = std::ranges::any_of(scene.panels[0].items, [](const Item& item) {
      const auto* points = std::get_if<Points>(&item);
      return points != nullptr && points->marker == Marker::dot;
    });
    EXPECT_EQ(named, beside_m > 0);
    EXPECT_EQ(drawn, named);
  }
}

TEST(ScanOverlay, NamesOnlyTheVerdictsThatItShows) {
  const Case c = simulated(1);
  FigureInput input = c.input({});
  for (NamedResult& named : input.results)
    named.verdicts = {{.lines = std::vector(named.result->lines.at(0).lines.size(), LineVerdict::right), .missed = {}}};
  const Scene scene = Registry<Figure>::make("scan_overlay")->draw(input).at(0).scene;
  const auto has = [&](const char* text) {
    return std::ranges::find(scene.legend, text, &LegendEntry::text) != scene.legend.end();
  };
  EXPECT_TRUE(has("right"));
  for (const char* absent : {"split", "false", "missed"}) EXPECT_FALSE(has(absent)) << absent;
}

TEST(Figures, DrawPanelsThatShowTheSameThingOnce) {
  Case c = simulated(6);
  c.results[1] = c.results[0];
  c.results[1].map.lines[0].segment.a += Vec2(0.5, 0);  // another map of the same lines
  c.results[2].map = c.results[0].map;
  for (const auto& [name, panels, title] :
       {std::tuple("scan_overlay", 2U, "iepf, line_tracking"), std::tuple("lines_world", 2U, "iepf, line_tracking"),
        std::tuple("map", 2U, "iepf, smf")}) {
    const auto scenes = Registry<Figure>::make(name)->draw(c.input({}));
    ASSERT_EQ(scenes.size(), 1U) << name;
    EXPECT_EQ(scenes[0].scene.panels.size(), panels) << name;
    EXPECT_TRUE(scenes[0].scene.panels.at(0).title.starts_with(title)) << scenes[0].scene.panels[0].title;
  }
}

TEST(ScanOverlay, ShowsTheWorstScanBesideTheMedianOne) {
  const Case c = simulated(9);
  FigureInput input = c.input({});
  for (NamedResult& named : input.results)  // in scan f, f lines are false and the others right
    for (std::size_t f = 0; f < 9; ++f) {
      const std::size_t lines = named.result->lines[f].lines.size();
      named.verdicts.push_back({std::vector(lines, LineVerdict::right), std::vector<Segment>(f, {{0, 1}, {1, 1}})});
    }
  std::vector<std::pair<double, std::size_t>> by_share;
  for (std::size_t f = 0; f < 9; ++f) {
    double share = 0.0;
    for (const NamedResult& named : input.results) {
      const auto n = static_cast<double>(named.result->lines[f].lines.size());
      share += n + static_cast<double>(f) > 0 ? n / (n + static_cast<double>(f)) : 1.0;
    }
    by_share.emplace_back(share, f);
  }
  std::ranges::sort(by_share);
  const auto scenes = Registry<Figure>::make("scan_overlay")->draw(input);
  ASSERT_EQ(scenes.size(), 1U);
  const Scene& scene = scenes[0].scene;
  ASSERT_EQ(scene.panels.size(), 6U);  // two for each pipeline
  EXPECT_EQ(scene.columns % 2, 0);
  const std::string title = "the median scan (" + std::to_string(by_share[4].second) + ") and the worst (" +
                            std::to_string(by_share[0].second) + ")";
  EXPECT_NE(scene.title.find(title), std::string::npos) << scene.title;
  EXPECT_NE(scene.panels[0].title.find(", median:"), std::string::npos);
  EXPECT_NE(scene.panels[1].title.find(", worst:"), std::string::npos);
}

TEST(Overlays, DistinguishRightSplitFalseAndMissedLinesByColourAndDash) {
  const Case c = simulated(9);
  FigureInput input = c.input({});
  for (NamedResult& named : input.results) named.verdicts = some_verdicts(*named.result);
  for (const std::string name : {"scan_overlay", "lines_world"}) {
    const Scene scene = Registry<Figure>::make(name)->draw(input).at(0).scene;
    std::vector<LegendEntry> looks;
    for (const char* verdict : {"right", "split", "false", "missed"}) {
      const auto entry = std::ranges::find(scene.legend, verdict, &LegendEntry::text);
      ASSERT_NE(entry, scene.legend.end()) << name << " " << verdict;
      looks.push_back(*entry);
      EXPECT_TRUE(std::ranges::any_of(scene.panels,
                                      [&](const Panel& panel) {
                                        return std::ranges::any_of(panel.items, [&](const Item& item) {
                                          const auto* lines = std::get_if<Lines>(&item);
                                          return lines != nullptr && lines->stroke.color == entry->stroke->color &&
                                                 lines->stroke.dash == entry->stroke->dash && !lines->segments.empty();
                                        });
                                      }))
          << name << " draws no line that is " << verdict;
    }
    for (std::size_t i = 0; i < looks.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) {
        EXPECT_NE(looks[i].stroke->color, looks[k].stroke->color);
        EXPECT_NE(looks[i].stroke->dash, looks[k].stroke->dash);
        EXPECT_NE(looks[i].marker, looks[k].marker);
      }
    keep(name + "_judged.png", to_png(scene));
  }
}

// 200 returns within 10 m, two 7 m farther out: the view is that of the 200, and the figure says that two are outside.
TEST(SetView, IsNotStretchedByTwoStrayPoints) {
  std::vector<Vec2> points;
  for (int i = 0; i < 200; ++i) points.emplace_back(0.05 * i, 3.0 + std::sin(0.1 * i));
  Panel without;
  set_view(points, {}, without);
  points.emplace_back(17.0, 3.0);
  points.emplace_back(3.0, -7.0);
  Panel panel{.tell_outside = "point", .items = {Points{.points = points}}};
  set_view(points, {}, panel);
  EXPECT_EQ(panel.x.range, without.x.range);
  EXPECT_EQ(panel.y.range, without.y.range);
  const std::array far{Vec2(17.0, 3.0)};
  Panel held;
  set_view(points, far, held);
  EXPECT_GE(held.x.range->second, 17.0);
  // The margin is a share of the longer side; the other side is not stretched to its stray point at -7.
  EXPECT_GT(held.y.range->first, without.y.range->first - 0.05 * 17.0);
  EXPECT_NEAR(held.y.range->first + held.y.range->second, without.y.range->first + without.y.range->second, 1e-9);
}

// The end of a corridor, which few scans see, is not stray: no gap separates it from the rest.
TEST(SetView, KeepsTheEndOfACorridor) {
  std::vector<Vec2> points;
  for (int i = 0; i < 1000; ++i) points.emplace_back(10.0 * std::sqrt(i / 1000.0), 0.0);
  Panel panel;
  set_view(points, {}, panel);
  EXPECT_LE(panel.x.range->first, points.front().x());
  EXPECT_GE(panel.x.range->second, points.back().x());
}

TEST(Figures, HaveNoTextBelowEightPoints) {
  const Case c = simulated(20);
  for (const std::string& name : Registry<Figure>::names())
    for (const NamedScene& figure : Registry<Figure>::make(name)->draw(c.input(test::abcdef_waypoints())))
      for (const Shape& shape : layout(figure.scene).shapes)
        if (const auto* text = std::get_if<TextShape>(&shape.what)) {
          EXPECT_GE(text->size, 8.0) << name << ": " << text->text;
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
  EXPECT_EQ(panel.x.label, "x");
  EXPECT_EQ(panel.x.unit, "m");
  EXPECT_EQ(std::get<Polygon>(panel.items.at(0)).points,
            (std::vector<Vec2>{{5, 4}, {10, 7}, {20, 1}, {20, 6}, {10, 9}, {5, 4}}));
  EXPECT_EQ(std::get<Polyline>(panel.items.at(1)).points, (std::vector<Vec2>{{5, 4}, {10, 8}, {20, 3}}));
  EXPECT_EQ(scenes[0].scene.legend.at(0).text, "wide");
}

TEST(Sweep, ShowsAllVariedParametersInWordsIfNoneIsNamed) {
  const Recording none;
  FigureInput input{.title = "t", .recording = none, .waypoints = {}, .results = {}};
  for (const auto& [angle, window] : {std::pair(5.0, 3.0), std::pair(9.0, 3.0), std::pair(5.0, 7.0)})
    input.measured.push_back({.pipeline = "p",
                              .slots = {{"merge a", {{"max_angle_deg", angle}, {"window", window}}}},
                              .units = {{"merge.max_angle_deg", "deg"}},
                              .metrics = {{"map_lines", {angle + window}}}});
  input.looks = {{"map_lines", {.label = "map lines"}}};
  const Scene scene = Registry<Figure>::make("sweep", {{"metric", std::string("map_lines")}})->draw(input).at(0).scene;
  ASSERT_EQ(scene.panels.size(), 2U);
  EXPECT_EQ(scene.panels[0].x.label, "max angle");
  EXPECT_EQ(scene.panels[0].x.unit, "deg");
  EXPECT_EQ(scene.panels[1].x.label, "window");
  EXPECT_EQ(scene.panels[0].y.label, "map lines");
  EXPECT_EQ(scene.title, "t: map lines against max angle and window");
}

TEST(Sweep, NamesTheTargetInItsLegend) {
  const Recording none;
  FigureInput input{.title = "t", .recording = none, .waypoints = {}, .results = {}};
  for (const double x : {1.0, 2.0})
    input.measured.push_back(
        {.pipeline = "p", .slots = {{"merge a", {{"x", x}}}}, .units = {}, .metrics = {{"n", {x}}}});
  const ParamSet params{
      {"parameters", std::string("merge.x")}, {"metric", std::string("n")}, {"target", std::vector<double>{1.5}}};
  const Scene scene = Registry<Figure>::make("sweep", params)->draw(input).at(0).scene;
  const auto target = std::ranges::find(scene.legend, "target 1.5", &LegendEntry::text);
  ASSERT_NE(target, scene.legend.end());
  const auto drawn = std::ranges::find_if(scene.panels[0].items, [](const Item& item) {
    const auto* line = std::get_if<Polyline>(&item);
    return line != nullptr && line->points.front().y() == 1.5 && line->points.back().y() == 1.5;
  });
  ASSERT_NE(drawn, scene.panels[0].items.end());
  EXPECT_EQ(std::get<Polyline>(*drawn).stroke.dash, target->stroke->dash);
}

}  // namespace
}  // namespace scanbench::render
