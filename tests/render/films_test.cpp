// Films: the frames that are chosen, and frames of one size.
#include "render/film.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <variant>
#include <vector>

#include "core/contracts/force_field_trace.hpp"
#include "core/contracts/map_trace.hpp"
#include "core/registry.hpp"
#include "render/films/stage.hpp"
#include "render/layout/layout.hpp"

namespace scanbench::render {
namespace {

using ::testing::ElementsAre;

TEST(Film, ShowsTheFirstAndTheLastStepAndAnEvenSelectionOfTheOthers) {
  EXPECT_THAT(chosen_steps(5, 200), ElementsAre(0U, 1U, 2U, 3U, 4U));
  EXPECT_THAT(chosen_steps(9, 3), ElementsAre(0U, 4U, 8U));
  EXPECT_THAT(chosen_steps(1, 200), ElementsAre(0U));
  const auto many = chosen_steps(100000, 200);
  EXPECT_EQ(many.size(), 200U);
  EXPECT_EQ(many.back(), 99999U);
}

/// Three scans of a wall two metres to the left of a robot that drives one metre per scan.
struct Drive {
  Recording recording;
  PipelineResult result;
  TraceRows trace;

  Drive() {
    recording.observed.sensor.geometry = ScanGeometry(kPi / 2, 0.1, 1);
    for (int f = 0; f < 3; ++f) {
      Frame frame;
      frame.ranges = {2.0};
      frame.odom_from_sensor = Pose2(f, 0, 0);
      recording.observed.frames.push_back(frame);
      ScanLines lines;
      LineFeature wall;
      wall.segment = {{1, 2}, {-1, 2}};
      lines.lines.push_back(wall);
      lines.labels = {0};
      result.lines.push_back(lines);
    }
  }
  FigureInput input() const {
    FigureInput input{.title = "t", .recording = recording, .waypoints = {}, .results = {}};
    input.results.push_back({"p", &result, &trace});
    return input;
  }
};

std::size_t segments_of(const Scene& scene) {
  std::size_t count = 0;
  for (const Item& item : scene.panels.front().items)
    if (const auto* lines = std::get_if<Lines>(&item)) count += lines->segments.size();
  return count;
}

TEST(Film, OfADriveAndOfAMapKeepsItsRangesAndSize) {
  const Drive drive;
  const FigureInput input = drive.input();
  for (const char* kind : {"drive", "map"}) {
    const auto film = Registry<FilmKind>::make(kind)->make(input, 200);
    ASSERT_TRUE(film) << kind;
    ASSERT_EQ(film->frames, 3U);
    const Layout first = layout(film->scene(0));
    for (std::size_t k = 1; k < 3; ++k) {
      const Layout other = layout(film->scene(k));
      EXPECT_EQ(first.width, other.width);
      EXPECT_EQ(first.height, other.height);
      EXPECT_EQ(first.panels[0].x_min, other.panels[0].x_min) << kind;
      EXPECT_EQ(first.panels[0].y_max, other.panels[0].y_max) << kind;
    }
  }
}

TEST(Film, OfAMapHasTheLinesOfTheTraceAfterEachScan) {
  Drive drive;
  const auto line = [&](int frame, int number) {
    const auto values = values_of(mapping::BornRow{number, 0, 2, 1, 2});
    drive.trace["map.born"].push_back({frame, {values.begin(), values.end()}});
  };
  line(0, 0), line(1, 1), line(2, 2);
  drive.trace["map.gone"].push_back({2, {0.0}});
  const FigureInput input = drive.input();
  const auto film = Registry<FilmKind>::make("map")->make(input, 200);
  ASSERT_TRUE(film);
  // Each frame also shows the line of its scan.
  EXPECT_EQ(segments_of(film->scene(0)), 1U + 1U);
  EXPECT_EQ(segments_of(film->scene(1)), 2U + 1U);
  EXPECT_EQ(segments_of(film->scene(2)), 2U + 1U);  // one came, one went
}

TEST(Film, OfAnAlignmentHasAFrameForEachIteration) {
  Drive drive;
  for (int iteration = 0; iteration < 4; ++iteration)
    for (int scan = 0; scan < 3; ++scan) {
      const auto values = values_of(force_field::PoseRow{iteration, scan, 1.0 * scan, 0.1 * iteration, 0});
      drive.trace["align.pose"].push_back({-1, {values.begin(), values.end()}});
    }
  const FigureInput input = drive.input();
  const auto film = Registry<FilmKind>::make("alignment")->make(input, 200);
  ASSERT_TRUE(film);
  EXPECT_EQ(film->frames, 4U);
  EXPECT_EQ(segments_of(film->scene(3)), 3U);                 // a wall per scan
  EXPECT_EQ(film->scene(3).panels.front().items.size(), 3U);  // each scan has its own colour
}

TEST(Film, OfAnAlignmentKeepsTheHypothesesInItsLastFrame) {
  // Hypotheses are made before an iteration, so none is written after the last one.
  Drive drive;
  for (int iteration = 0; iteration < 3; ++iteration) {
    for (int scan = 0; scan < 3; ++scan) {
      const auto values = values_of(force_field::PoseRow{iteration, scan, 1.0 * scan, 0, 0});
      drive.trace["align.pose"].push_back({-1, {values.begin(), values.end()}});
    }
    force_field::HypothesisRow line{.iteration = iteration, .fate = 1};
    line.x2_m = line.x3_m = line.x4_m = 2.0;
    const auto values = values_of(line);
    if (iteration < 2) drive.trace["align.hypothesis"].push_back({-1, {values.begin(), values.end()}});
  }
  const FigureInput input = drive.input();
  const auto film = Registry<FilmKind>::make("alignment")->make(input, 200);
  ASSERT_TRUE(film);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_EQ(std::ranges::count_if(film->scene(k).panels.front().items,
                                    [](const Item& item) { return std::holds_alternative<Polyline>(item); }),
              1)
        << "frame " << k;
  // Those that are given up in the last iteration but one are not.
  drive.trace["align.hypothesis"].back().values[3] = 3;
  const FigureInput dropped = drive.input();
  const Scene last = Registry<FilmKind>::make("alignment")->make(dropped, 200)->scene(2);
  EXPECT_EQ(last.panels.front().items.size(), 3U) << "the lines of three scans";
}

TEST(Film, WithoutItsRowsThereIsNone) {
  const Drive drive;
  const FigureInput input = drive.input();
  EXPECT_FALSE(Registry<FilmKind>::make("alignment")->make(input, 200));
  EXPECT_FALSE(Registry<FilmKind>::make("mean_shift")->make(input, 200));
}

}  // namespace
}  // namespace scanbench::render
