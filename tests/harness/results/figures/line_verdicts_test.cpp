// Verdicts on lines of one scan of a wall at x = 2 m, and of another at y = 3 m that no line explains.
#include "harness/results/figures/line_verdicts.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace scanbench::results {
namespace {

constexpr int kBeams = 181;  // from -45 to 135 degrees

Recording two_walls() {
  Recording recording;
  recording.observed.sensor.geometry = ScanGeometry(radians(-45), radians(1), kBeams);
  Truth truth;
  truth.walls = {{"east", {{2, -2}, {2, 2}}}, {"north", {{1.5, 3}, {-3, 3}}}};
  truth.world_from_sensor = {Pose2()};
  Frame frame{0.0, {}, Pose2()};
  for (int beam = 0; beam < kBeams; ++beam) {
    const Vec2 d = recording.observed.sensor.geometry.direction(beam);
    const double east = 2.0 / d.x(), north = 3.0 / d.y();
    double range = INFINITY;
    int id = -1;
    if (east > 0 && std::abs(east * d.y()) <= 2) range = east, id = 0;
    if (north > 0 && north * d.x() <= 1.5 && north * d.x() >= -3 && north < range) range = north, id = 1;
    frame.ranges.push_back(range);
    truth.ranges.push_back(range);
    truth.wall_ids.push_back(id);
  }
  recording.observed.frames.push_back(std::move(frame));
  recording.truth = std::move(truth);
  return recording;
}

LineFeature line(const Segment& segment) {
  LineFeature feature;
  feature.segment = segment;
  feature.line = line_through(segment.a, segment.b);
  return feature;
}

TEST(LineVerdicts, AreRightSplitFalseAndMissed) {
  const Recording recording = two_walls();
  PipelineResult result;
  result.lines.resize(1);
  result.lines[0].lines = {line({{2, -2}, {2, 0.8}}), line({{2, 0.9}, {2, 2}}), line({{0, 0}, {1, 1}})};
  const auto verdicts = line_verdicts(recording, result);
  ASSERT_EQ(verdicts.size(), 1U);
  using enum render::LineVerdict;
  EXPECT_EQ(verdicts[0].lines, (std::vector{right, split, false_line}));
  ASSERT_EQ(verdicts[0].missed.size(), 1U);
  EXPECT_NEAR(verdicts[0].missed[0].a.y(), 3.0, 1e-9);
  EXPECT_NEAR(verdicts[0].missed[0].b.y(), 3.0, 1e-9);
}

TEST(LineVerdicts, AreTooSmallForRightLinesOnWallsOfWhichTooLittleIsSeen) {
  Recording recording = two_walls();
  for (std::size_t beam = 0; beam < kBeams; ++beam)  // eight returns of the wall at y = 3 m, about 0.4 m
    if (beam < 131 && recording.truth->wall_ids[beam] == 1) recording.observed.frames[0].ranges[beam] = INFINITY;
  for (std::size_t beam = 139; beam < kBeams; ++beam) recording.observed.frames[0].ranges[beam] = INFINITY;
  PipelineResult result;
  result.lines.resize(1);
  result.lines[0].lines = {line({{2, -2}, {2, 2}}), line({{0.1, 3}, {-0.5, 3}}), line({{0.1, 2}, {-0.5, 2}})};
  using enum render::LineVerdict;
  EXPECT_EQ(line_verdicts(recording, result)[0].lines, (std::vector{right, too_small, false_line}));
}

TEST(LineVerdicts, FollowTheRulesOfTheScenario) {
  const Recording recording = two_walls();
  PipelineResult result;
  result.lines.resize(1);
  result.lines[0].lines = {line({{2.1, -2}, {2.1, 2}})};  // 10 cm behind the wall
  using enum render::LineVerdict;
  EXPECT_EQ(line_verdicts(recording, result)[0].lines, std::vector{right});
  const auto strict = segment_rules({{"metrics", "segments", {{"max_offset_m", 0.05}}}});
  EXPECT_EQ(line_verdicts(recording, result, strict)[0].lines, std::vector{false_line});
}

TEST(LineVerdicts, AreNoneWithoutTruth) {
  Recording recording = two_walls();
  recording.truth.reset();
  PipelineResult result;
  result.lines.resize(1);
  EXPECT_TRUE(line_verdicts(recording, result).empty());
}

}  // namespace
}  // namespace scanbench::results
