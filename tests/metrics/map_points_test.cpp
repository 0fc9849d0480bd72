// map_points compared with values computed by hand.
#include "core/special_values.hpp"
#include "made_up.hpp"

namespace scanbench::test {
namespace {

MapLine map_line(const Vec2& a, const Vec2& b) {
  MapLine line;
  line.segment = {a, b};
  return line;
}

/// Four beams along the axes, all at 1 m; world_from_sensor as given.
MadeUpRun cross_run(const Pose2& pose) {
  MadeUpRun run = make_run(ScanGeometry(0.0, kPi / 2, 4), {});
  add_frame(run, Pose2(), std::vector<double>(4, 1.0), std::vector<std::int32_t>(4, -1));
  run.result.world_from_sensor = {pose};
  return run;
}

TEST(MapPoints, DistancesAreMeansOverTheInliersOfTheScansLines) {
  // Points (1, 0), (0, 1), (-1, 0), (0, -1); the scan's line x = 1 is 0, 1, 2, 1 away: mean 1, deviation sqrt(1/2).
  MadeUpRun run = cross_run({});
  add_line(run, 0, line_between({1, -1}, {1, 1}), {});
  run.result.map.lines = {map_line({1.1, -1}, {1.1, 1})};
  const auto all = evaluate("map_points", run);
  expect_value(all, "D_S", "all", (0 + 1 + 2 + 1) / 4.0, 4);
  expect_value(all, "D_M", "all", (0.1 + 1.1 + 2.1 + 1.1) / 4.0, 4);
  const auto near = evaluate("map_points", run, {{"inlier_sigmas", 1.0}});  // 2 > 1 + 0.707
  expect_value(near, "D_S", "all", (0 + 1 + 1) / 3.0, 3);
  expect_value(near, "D_M", "all", (0.1 + 1.1 + 1.1) / 3.0, 3);
  expect_value(near, "inliers", "all", 3.0 / 4.0, 4);
}

TEST(MapPoints, PointsAndLinesArePlacedByTheEstimatedPoses) {
  MadeUpRun run = cross_run(Pose2(10, 5, kPi / 2));
  add_line(run, 0, line_between({1, -1}, {1, 1}), {});
  run.result.map.lines = {map_line({11, 6}, {9, 6})};  // the same line in the world
  const auto rows = evaluate("map_points", run);
  expect_value(rows, "D_S", "all", 1.0, 4);
  expect_value(rows, "D_M", "all", 1.0, 4);
}

TEST(MapPoints, CompressionCountsNumbersAndBytes) {
  MadeUpRun run = cross_run({});
  run.observed.frames[0].ranges[3] = kInf;
  run.result.map.lines = {map_line({1, -1}, {1, 1}), map_line({0, 0}, {1, 0})};
  const auto rows = evaluate("map_points", run);
  expect_value(rows, "compression", "all", 3.0 * 2 / (2.0 * 4), 2);
  expect_value(rows, "compression_bytes", "all", (4.0 + 3.0) / (2.0 * 4), 2);  // 4 ranges and a pose
  expect_value(rows, "scan_points", "all", 3, 1);
  expect_value(rows, "map_lines", "all", 2, 1);
}

TEST(MapPoints, WithoutAMapOrLinesTheDistancesAreUndefined) {
  MadeUpRun run = cross_run({});
  auto rows = evaluate("map_points", run);
  for (const char* metric : {"D_S", "D_M", "inliers", "compression", "compression_bytes"})
    expect_undefined(rows, metric);
  add_line(run, 0, line_between({1, -1}, {1, 1}), {});
  rows = evaluate("map_points", run);
  expect_value(rows, "D_S", "all", 1.0, 4);
  expect_undefined(rows, "D_M");
}

TEST(MapPoints, CountsClustersByTheirLinesAndIgnoresDroppedLines) {
  MadeUpRun run = cross_run({});
  for (const char* metric : {"clusters1", "clusters2"}) expect_undefined(evaluate("map_points", run), metric);
  run.result.merge_labels = {{0, 0, 4, 7, 0}, {0, 1, 4, 8, 0}, {0, 2, 6, 9, 1}, {0, 3, -1, -1, -1}};
  const auto rows = evaluate("map_points", run);
  expect_value(rows, "clusters1", "all", 2, 0);
  expect_value(rows, "clusters2", "all", 3, 0);
}

TEST(MapPoints, CompressionOfLinesWithoutScansIsUndefined) {
  MadeUpRun run = cross_run({});
  for (double& range : run.observed.frames[0].ranges) range = kInf;
  run.result.map.lines = {map_line({1, -1}, {1, 1})};
  const auto rows = evaluate("map_points", run);
  for (const char* metric : {"compression", "compression_bytes"}) expect_undefined(rows, metric);
  expect_value(rows, "map_lines", "all", 1, 1);
}

TEST(MapPoints, NeedsPosesButNoTruth) {
  MadeUpRun run = cross_run({});
  EXPECT_TRUE(family("map_points")->applies(run.input_without_truth()));
  run.result.world_from_sensor.clear();
  EXPECT_FALSE(family("map_points")->applies(run.input_without_truth()));
}

}  // namespace
}  // namespace scanbench::test
