// Parts of lines that are true, false and missed, where the places of the cuts are known.
#include "harness/results/figures/figure_input/line_difference.hpp"

#include <gtest/gtest.h>

namespace scanbench::results {
namespace {

struct MapBesideWalls {
  Recording recording;
  PipelineResult result;
  MapBesideWalls(const std::vector<Segment>& walls, const std::vector<Segment>& lines) {
    recording.truth.emplace();
    for (const Segment& s : walls) recording.truth->walls.push_back({"", s});
    result.has_map = true;
    for (const Segment& s : lines) result.map.lines.push_back({.segment = s});
  }
};

double length_of(const std::vector<Segment>& parts) {
  double sum = 0.0;
  for (const Segment& s : parts) sum += s.length();
  return sum;
}

TEST(LineDifference, CutsLinesWhereTheyLeaveTheWalls) {
  // A wall from 0 to 4 m; a line beside it from 3 to 6 m, drawn from right to left.
  const MapBesideWalls run({{{0, 0}, {4, 0}}}, {{{6, 0.03}, {3, 0.03}}});
  const auto d = line_difference(run.recording, run.result, {});
  ASSERT_TRUE(d.has_value());
  // Near is 5 cm: 4 cm beyond the end of the wall, 4 cm beyond the end of the line.
  ASSERT_EQ(d->right.size(), 1U);
  EXPECT_NEAR((d->right[0].a - Vec2(3, 0.03)).norm(), 0, 1e-9);
  EXPECT_NEAR((d->right[0].b - Vec2(4.045, 0.03)).norm(), 0, 1e-9);
  ASSERT_EQ(d->wrong.size(), 1U);
  EXPECT_NEAR((d->wrong[0].b - Vec2(6, 0.03)).norm(), 0, 1e-9);
  ASSERT_EQ(d->missed.size(), 1U);
  EXPECT_NEAR((d->missed[0].b - Vec2(2.955, 0)).norm(), 0, 1e-9);
  EXPECT_EQ(d->right_pixels, 105);
  EXPECT_EQ(d->wrong_pixels, 301 - 105);
  EXPECT_EQ(d->missed_pixels, 296);
}

TEST(LineDifference, LosesNoPartOfSteepLines) {
  const MapBesideWalls run({{{0, 0}, {1, 5}}, {{3, 5}, {2, 0}}}, {{{1, 5}, {0, 0}}, {{4, 0}, {4, 3}}});
  const auto d = line_difference(run.recording, run.result, {});
  ASSERT_TRUE(d.has_value());
  EXPECT_NEAR(length_of(d->right), std::sqrt(26.0), 1e-9);
  EXPECT_NEAR(length_of(d->wrong), 3.0, 1e-9);
  EXPECT_NEAR(length_of(d->missed), std::sqrt(26.0), 1e-9);
}

TEST(LineDifference, WithoutLinesAllIsMissedAndWithoutWallsThereIsNone) {
  const MapBesideWalls empty({{{0, 0}, {1, 5}}}, {});
  const auto d = line_difference(empty.recording, empty.result, {});
  ASSERT_TRUE(d.has_value());
  EXPECT_NEAR(length_of(d->missed), std::sqrt(26.0), 1e-9);
  EXPECT_EQ(d->missed_pixels, 501);
  EXPECT_FALSE(line_difference(MapBesideWalls({}, {}).recording, empty.result, {}).has_value());
}

TEST(RasterRules, AreThoseOfTheScenariosMetric) {
  EXPECT_EQ(raster_rules({}).resolution_m, 0.01);
  EXPECT_EQ(raster_rules({{"metrics", "raster_truth", {{"resolution_m", 0.05}}}}).resolution_m, 0.05);
}

}  // namespace
}  // namespace scanbench::results
