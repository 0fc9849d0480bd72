// The three correlations on scans without noise: exact poses in a room, an open axis in a corridor.
#include "algorithms/map/navigation/correlation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.hpp"
#include "tests/support/aligning.hpp"
#include "tests/support/scan_builder.hpp"

namespace scanbench::mapping::navigation {
namespace {

/// A scan of walls and the lines in it.
struct Seen {
  Seen(const std::vector<Segment>& walls, const Pose2& pose) : series(), truth(pose) {
    series.add_exact(support::cast(support::ring_sensor(361), walls, pose));
    const Observation observation = series.observations().front();
    points = valid_points(observation.scan).points;
    segments = scan_segments(observation, 0.0);
  }
  support::ScanSeries series;
  Pose2 truth;
  std::vector<Vec2> points;
  std::vector<ScanSegment> segments;
};

Registration by_segments(const Seen& seen, const std::vector<Segment>& map, const Pose2& predicted) {
  const FindPairs pairs = [&](const Pose2& pose, double gate) {
    return segment_segment_pairs(seen.segments, map, pose, gate, {});
  };
  return register_on_lines(pairs, predicted, total_length(seen.segments), 3.0, {});
}

Registration by_points(const Seen& seen, const std::vector<Segment>& map, const Pose2& predicted) {
  const FindPairs pairs = [&](const Pose2& pose, double gate) {
    return segment_point_pairs(seen.points, map, pose, gate);
  };
  return register_on_lines(pairs, predicted, static_cast<double>(seen.points.size()), 3.0, {});
}

void expect_pose(const Pose2& found, const Pose2& truth, double tolerance) {
  EXPECT_NEAR((found.translation() - truth.translation()).norm(), 0.0, tolerance);
  EXPECT_NEAR(wrap_angle(found.yaw() - truth.yaw()), 0.0, tolerance);
}

TEST(Correlation, SegmentsAndPointsFindThePoseInARoomExactly) {
  const std::vector<Segment> room = support::box(-4, -3, 5, 3.5);
  const Seen seen(room, {0.3, -0.2, 0.4});
  const Pose2 predicted(0.4, -0.1, 0.43);
  expect_pose(by_segments(seen, room, predicted).map_from_sensor, seen.truth, 1e-9);
  expect_pose(by_points(seen, room, predicted).map_from_sensor, seen.truth, 1e-9);
}

TEST(Correlation, AnExactPredictionIsNotCorrected) {
  const std::vector<Segment> room = support::box(-4, -3, 5, 3.5);
  const Seen seen(room, {0.3, -0.2, 0.4});
  expect_pose(by_segments(seen, room, seen.truth).map_from_sensor, seen.truth, 1e-12);
  expect_pose(by_points(seen, room, seen.truth).map_from_sensor, seen.truth, 1e-12);
}

TEST(Correlation, ACorridorLeavesItsAxisAsPredicted) {
  const std::vector<Segment> corridor{{{-40, -1}, {40, -1}}, {{40, 1}, {-40, 1}}};
  const Seen seen(corridor, {0, 0.1, 0});
  const Pose2 predicted(0.2, 0.15, 0.01);
  for (const Registration& found : {by_segments(seen, corridor, predicted), by_points(seen, corridor, predicted)}) {
    EXPECT_EQ(found.status, Status::degenerate);
    EXPECT_EQ(found.rank, 2);
    EXPECT_NEAR(found.map_from_sensor.x(), 0.2, 1e-9);
    EXPECT_NEAR(found.map_from_sensor.y(), 0.1, 1e-9);
  }
}

TEST(Correlation, PointsWithPointsFindACopyThatMovedLessThanHalfTheSpacing) {
  const std::vector<Segment> room = support::box(-1, -0.8, 1.2, 0.9);  // 361 beams: points some 2 cm apart
  const Seen seen(room, {});
  PointMap map(0.001);
  map.add(seen.points);
  const FindPairs pairs = [&](const Pose2& pose, double gate) {
    return point_point_pairs(seen.points, map, pose, gate);
  };
  const Registration found =
      register_on_lines(pairs, {0.003, -0.002, 0.001}, static_cast<double>(seen.points.size()), 1.0, {});
  expect_pose(found.map_from_sensor, {}, 1e-9);
}

TEST(Correlation, AWallIsNoPartnerForReturnsOnItsOtherFace) {
  const std::vector<Segment> wall{{{-1, 1}, {1, 1}}};  // free space above it
  const std::vector<Vec2> points{{0, 0.98}};           // seen from below
  EXPECT_TRUE(segment_point_pairs(points, wall, {}, 0.5).empty());
  const std::vector<Segment> reversed{{{1, 1}, {-1, 1}}};
  EXPECT_EQ(segment_point_pairs(points, reversed, {}, 0.5).size(), 1u);
}

TEST(PointMap, FindsTheNearestOfAllPoints) {
  PointMap map(1e-6);
  std::vector<Vec2> held;
  CounterRng rng(9, RngStream::pose);
  for (int k = 0; k < 300; ++k) held.emplace_back(4 * rng.uniform() - 2, 4 * rng.uniform() - 2);
  map.add(held);
  for (int k = 0; k < 100; ++k) {
    const Vec2 p(4 * rng.uniform() - 2, 4 * rng.uniform() - 2);
    double nearest = 0.3;
    for (const Vec2& q : held) nearest = std::min(nearest, (p - q).norm());
    const Vec2* found = map.nearest(p, 0.3);
    if (nearest < 0.3) {
      ASSERT_NE(found, nullptr);
      EXPECT_EQ((*found - p).norm(), nearest);
    } else {
      EXPECT_EQ(found, nullptr);
    }
  }
}

TEST(PointMap, KeepsOnePointACell) {
  PointMap map(0.1);
  map.add(std::vector<Vec2>{{0.01, 0.01}, {0.05, 0.05}});
  EXPECT_TRUE(*map.nearest({0.05, 0.05}, 0.5) == Vec2(0.01, 0.01));
}

}  // namespace
}  // namespace scanbench::mapping::navigation
