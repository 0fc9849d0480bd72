// The figures of merging on the spiral, on one line and on none. With SCANBENCH_FIGURE_DIR set, the files are
// written there.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <set>

#include "core/contracts/mean_shift_trace.hpp"
#include "core/registry.hpp"
#include "core/trace/trace_rows.hpp"
#include "merged.hpp"
#include "render/backends/cairo.hpp"
#include "render/backends/gl.hpp"
#include "render/figure.hpp"
#include "render/figures/parts/clusters.hpp"
#include "render/figures/parts/view_box.hpp"
#include "tests/support/spiral.hpp"

namespace scanbench::render {
namespace {

const std::vector<std::string> kFromTheTrace{"joint_space", "trajectories", "direction_clusters", "collinear_clusters",
                                             "projection"};
const std::vector<std::string> kFromTheMap{"merge_stages", "merge_detail", "alignment"};

FigureInput input_of(const std::string& title, const Recording& recording, std::vector<NamedResult> results) {
  return {.title = title, .recording = recording, .waypoints = {}, .results = std::move(results)};
}

NamedScene drawn(const std::string& figure, const test::Merged& merged, const std::string& title,
                 const ParamSet& params = {}) {
  const Recording recording = test::blind_recording();
  const FigureInput input = input_of(title, recording, {{"mean_shift", &merged.result, &merged.trace}});
  std::vector<NamedScene> scenes = Registry<Figure>::make(figure, params)->draw(input);
  EXPECT_EQ(scenes.size(), 1u) << figure;
  if (scenes.empty()) return {};
  const std::string svg = to_svg(scenes[0].scene);
  if (const char* dir = std::getenv("SCANBENCH_FIGURE_DIR"); dir != nullptr) {
    std::ofstream(std::string(dir) + "/" + title + "_" + figure + ".svg", std::ios::binary) << svg;
    std::ofstream(std::string(dir) + "/" + title + "_" + figure + ".png", std::ios::binary) << to_png(scenes[0].scene);
  }
  return scenes[0];
}

template <class Wanted>
std::vector<Wanted> items(const Panel& panel) {
  std::vector<Wanted> found;
  for (const Item& item : panel.items)
    if (const auto* wanted = std::get_if<Wanted>(&item)) found.push_back(*wanted);
  return found;
}

bool says(const Scene& scene, const std::string& what) {
  for (const Panel& panel : scene.panels)
    for (const Text& text : items<Text>(panel))
      if (text.text == what) return true;
  return false;
}

TEST(MergeFigures, AreDrawnOfTheSpiral) {
  const test::Merged spiral = test::merged_by_mean_shift(support::spiral());
  for (const auto* names : {&kFromTheTrace, &kFromTheMap})
    for (const std::string& name : *names) {
      const NamedScene figure = drawn(name, spiral, "spiral");
      EXPECT_EQ(figure.name, name);
      EXPECT_LT(to_svg(figure.scene).size(), 1'000'000u) << name;
      EXPECT_FALSE(says(figure.scene, "no segments")) << name;
    }
}

TEST(MergeFigures, OfOneLineAreDrawn) {
  const std::vector<MapLine> one{{.segment = {{1, 2}, {1.3, 2.1}}}};
  const test::Merged merged = test::merged_by_mean_shift(one);
  for (const auto* names : {&kFromTheTrace, &kFromTheMap})
    for (const std::string& name : *names) EXPECT_FALSE(drawn(name, merged, "one").caption.empty()) << name;
}

TEST(MergeFigures, OfNoLineAreEmptyAndSaySo) {
  const test::Merged merged = test::merged_by_mean_shift(std::vector<MapLine>{});
  for (const std::string& name : kFromTheTrace)
    EXPECT_TRUE(says(drawn(name, merged, "none").scene, "no segments")) << name;
  for (const std::string name : {"merge_stages", "merge_detail"})
    EXPECT_TRUE(says(drawn(name, merged, "none").scene, "no lines")) << name;
}

TEST(MergeFigures, OfAPipelineWithoutATraceAreNone) {
  const Recording recording = test::blind_recording();
  const test::Merged merged = test::merged_by_mean_shift(support::spiral());
  const TraceRows nothing, foreign{{"merge.joint_space", {{-1, {1.0, 2.0}}}}};
  for (const TraceRows* trace : {static_cast<const TraceRows*>(nullptr), &nothing, &foreign})
    for (const std::string& name : kFromTheTrace)
      EXPECT_TRUE(Registry<Figure>::make(name)->draw(input_of("t", recording, {{"p", &merged.result, trace}})).empty());
}

TEST(MergeFigures, OfRowsThatDoNotFitEachOtherAreStillDrawn) {
  test::Merged merged = test::merged_by_mean_shift(std::vector<MapLine>{{.segment = {{0, 0}, {0.3, 0}}}});
  const Recording recording = test::blind_recording();
  for (const std::string name : {"cluster", "trajectory1", "mode2", "kernel2", "projection", "merged"})
    for (const double index : {7.0, -3.0, 1e300, double{NAN}}) {
      std::vector<double> row = merged.trace["merge." + name].at(0).values;
      row[0] = index;
      merged.trace["merge." + name].push_back({-1, row});
    }
  for (const std::string& name : kFromTheTrace) EXPECT_FALSE(drawn(name, merged, "misfit").caption.empty());
}

TEST(MergeFigures, RequestTheRowsThatTheyDrawFrom) {
  const test::Merged all = test::merged_by_mean_shift(support::spiral());
  for (const auto* names : {&kFromTheTrace, &kFromTheMap})
    for (const std::string& name : *names) {
      test::Merged kept{all.result, {}};
      for (const std::string& row : Registry<Figure>::make(name)->trace_rows("mean_shift"))
        if (const auto found = all.trace.find(row); found != all.trace.end()) kept.trace.insert(*found);
      const NamedScene some = drawn(name, kept, "spiral"), whole = drawn(name, all, "spiral");
      EXPECT_EQ(to_svg(some.scene), to_svg(whole.scene)) << name;
      EXPECT_EQ(some.caption, whole.caption) << name;
    }
}

TEST(MergeFigures, ShowTheRequestedPipeline) {
  const Recording recording = test::blind_recording();
  const test::Merged none = test::merged_by_mean_shift(std::vector<MapLine>{});
  const test::Merged one = test::merged_by_mean_shift(std::vector<MapLine>{{.segment = {{0, 0}, {0.3, 0}}}});
  const FigureInput input =
      input_of("t", recording, {{"a", &none.result, &none.trace}, {"b", &one.result, &one.trace}});
  for (const std::string& name : kFromTheTrace) {
    const auto draw = [&](const std::string& of) {
      return Registry<Figure>::make(name, {{"pipeline", of}})->draw(input);
    };
    EXPECT_TRUE(says(draw("a").at(0).scene, "no segments")) << name;
    EXPECT_FALSE(says(draw("b").at(0).scene, "no segments")) << name;
    EXPECT_TRUE(draw("c").empty()) << name;
    EXPECT_TRUE((Registry<Figure>::make(name, {{"pipeline", std::string("a")}})->trace_rows("b").empty())) << name;
  }
}

TEST(JointSpace, HasAPointForEachOfThe300SegmentsOfFigure1) {
  const test::Merged whole = test::merged_by_mean_shift(support::spiral(), {}, {{"split_length_sigma", 6.0}});
  const NamedScene figure = drawn("joint_space", whole, "whole");
  EXPECT_NE(figure.caption.find("300 segments"), std::string::npos) << figure.caption;
  std::size_t points = 0;
  for (const Points& slice : items<Points>(figure.scene.panels.at(0))) points += slice.points.size();
  EXPECT_EQ(points, 300u);
}

TEST(Trajectories, NeverCrossTheBoxWhereADirectionPassesTheSeam) {
  // Pairs of segments at 176 and 2 degrees climb to each other through 180 = 0.
  std::vector<MapLine> lines;
  for (const double deg : {176.0, 177.0, 2.0, 1.0, 4.0}) {
    const Vec2 half = 0.2 * Vec2(std::cos(radians(deg)), std::sin(radians(deg)));
    lines.push_back({.segment = {Vec2(0.02 * deg, 0.0) - half, Vec2(0.02 * deg, 0.0) + half}});
    lines.push_back({.segment = {Vec2(0.3, 0.1) - half, Vec2(0.3, 0.1) + half}});
  }
  const NamedScene figure = drawn("trajectories", test::merged_by_mean_shift(lines), "seam");
  const Panel& joint = figure.scene.panels.at(1);
  const double height = joint.y.range->second - joint.y.range->first;
  std::size_t steps = 0;
  for (const Polyline& path : items<Polyline>(joint))
    for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
      const Vec2 step = path.points[i + 1] - path.points[i];
      if (!step.allFinite()) continue;
      ++steps;
      EXPECT_LT(std::abs(step.y()), 0.3 * height);
    }
  EXPECT_GT(steps, 4u);
}

TEST(DirectionClusters, NumberEveryClusterOfTheSpiral) {
  const test::Merged spiral = test::merged_by_mean_shift(support::spiral());
  std::set<int> clusters;
  for (const auto& row : rows_of<mean_shift::ClusterRow>(spiral.trace, "merge")) clusters.insert(row.cluster1);
  const NamedScene figure = drawn("direction_clusters", spiral, "spiral");
  EXPECT_EQ(items<Text>(figure.scene.panels.at(0)).size(), clusters.size());
}

TEST(CollinearClusters, ShowsThe30ModesAndThe30LinesOfFigure3) {
  const NamedScene figure = drawn("collinear_clusters", test::merged_by_mean_shift(support::spiral()), "spiral");
  ASSERT_EQ(figure.scene.panels.size(), 4u);
  EXPECT_EQ(items<Points>(figure.scene.panels[2]).at(0).points.size(), 30u);
  EXPECT_EQ(items<Lines>(figure.scene.panels[3]).at(1).segments.size(), 30u);
}

TEST(CollinearClusters, TheKernelIsTwoSigmaAlongTheClusterAndATenthAcross) {
  const std::vector<MapLine> one{{.segment = {{1, 2}, {1.3, 2.3}}}};  // at 45 degrees
  const NamedScene figure = drawn("collinear_clusters", test::merged_by_mean_shift(one), "one");
  const auto kernels = items<Ellipse>(figure.scene.panels.at(0));
  ASSERT_EQ(kernels.size(), 2u);  // a white rim, and the ellipse
  EXPECT_EQ(kernels[0].semi_axes, kernels[1].semi_axes);
  EXPECT_NEAR(kernels[0].semi_axes.x(), 2 * 0.20, 1e-12);
  EXPECT_NEAR(kernels[0].semi_axes.y(), 0.20 / 10, 1e-12);
  EXPECT_NEAR(kernels[0].angle_rad, radians(45), 1e-9);
}

TEST(Projection, UnitesTheTwoThatOverlapAndLeavesTheThirdAsInFigure4) {
  const std::vector<MapLine> three{{.segment = {{0.00, 0.005}, {0.20, 0.000}}},
                                   {.segment = {{0.15, -0.005}, {0.35, 0.000}}},
                                   {.segment = {{0.50, 0.000}, {0.62, 0.004}}}};
  const NamedScene figure = drawn("projection", test::merged_by_mean_shift(three), "three");
  const auto lines = items<Lines>(figure.scene.panels.at(1));
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].segments.size(), 3u);
  EXPECT_EQ(lines[1].segments.size(), 2u);
}

TEST(MergeStages, ShowsWhatCleaningErases) {
  // A wall that many points support and a short line that none does.
  const std::vector<MapLine> lines{{.segment = {{0, 0}, {3, 0}}}, {.segment = {{1, 2}, {1.2, 2}}}};
  std::vector<Vec2> points;
  for (int i = 0; i < 300; ++i) points.emplace_back(0.01 * i, 0.0);
  const NamedScene figure = drawn("merge_stages", test::merged_by_mean_shift(lines, points), "cleaned");
  ASSERT_EQ(figure.scene.panels.size(), 4u);
  EXPECT_EQ(items<Lines>(figure.scene.panels[0]).at(0).segments.size(), 2u) << "given";
  const auto after = items<Lines>(figure.scene.panels[1]);
  ASSERT_EQ(after.size(), 2u);
  ASSERT_EQ(after[0].segments.size(), 1u) << "erased";
  EXPECT_NEAR((after[0].segments[0].midpoint() - Vec2(1.1, 2)).norm(), 0, 1e-6);
  EXPECT_EQ(after[1].segments.size(), 1u) << "kept";
  // The details show the place of the erased line.
  for (const std::size_t i : {2u, 3u}) {
    const Panel& panel = figure.scene.panels[i];
    EXPECT_LT(panel.x.range->first, 1.1);
    EXPECT_GT(panel.x.range->second, 1.1);
    EXPECT_LT(panel.x.range->second - panel.x.range->first, 1.5);
  }
  const auto names = [&](const char* text) {
    return std::ranges::find(figure.scene.legend, text, &LegendEntry::text) != figure.scene.legend.end();
  };
  EXPECT_TRUE(names("erased by cleaning"));
  EXPECT_FALSE(names("scan points")) << "the lines cover them";
}

TEST(Alignment, ShowsThePosesOfAPipelineOnlyIfTheyAreNotThoseOfOdometry) {
  test::Merged merged = test::merged_by_mean_shift(std::vector<MapLine>{});
  EXPECT_EQ(drawn("alignment", merged, "odometry").scene.panels.size(), 1u);
  merged.result.world_from_sensor = {Pose2(0.1, 0.0, 0.0)};
  EXPECT_EQ(drawn("alignment", merged, "moved").scene.panels.size(), 2u);
}

TEST(Alignment, OfFourPanelsHasTwoRowsOfTwo) {
  test::Merged merged = test::merged_by_mean_shift(std::vector<MapLine>{});
  const Recording recording = test::blind_recording();
  FigureInput input = input_of("four", recording, {});
  std::vector<PipelineResult> results(3, merged.result);
  for (std::size_t k = 0; k < results.size(); ++k) {
    results[k].world_from_sensor = {Pose2(0.1 * static_cast<double>(k + 1), 0.0, 0.0)};
    input.results.push_back({"p" + std::to_string(k), &results[k]});
  }
  const auto scenes = Registry<Figure>::make("alignment", {{"every_pipeline", true}})->draw(input);
  ASSERT_EQ(scenes.size(), 1u);
  EXPECT_EQ(scenes[0].scene.panels.size(), 4u);
  EXPECT_EQ(scenes[0].scene.columns, 2);
}

TEST(ClusterColors, NeighboursDifferAndTheSamePlacesGiveTheSameColours) {
  std::vector<Vec2> places;
  for (int i = 0; i < 30; ++i) places.emplace_back(std::cos(0.4 * i) * i, std::sin(0.4 * i) * i);
  const std::vector<Color> colors = cluster_colors(places);
  EXPECT_EQ(colors, cluster_colors(places));
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::size_t nearest = i == 0 ? 1 : 0;
    for (std::size_t k = 0; k < places.size(); ++k)
      if (k != i && (places[k] - places[i]).norm() < (places[nearest] - places[i]).norm()) nearest = k;
    EXPECT_NE(colors[i], colors[nearest]) << i;
  }
}

TEST(FullestWindow, HoldsMostPlacesAndIsNoneWithoutPlaces) {
  EXPECT_FALSE(fullest_window({}, 1.0));
  const std::vector<Vec2> places{{0, 0}, {9, 9}, {9.2, 9.1}, {9.3, 8.8}, {5, 0}};
  const auto window = fullest_window(places, 1.0);
  ASSERT_TRUE(window);
  EXPECT_FALSE(window->contains(places[0]));
  for (std::size_t i = 1; i < 4; ++i) EXPECT_TRUE(window->contains(places[i]));
}

}  // namespace
}  // namespace scanbench::render
