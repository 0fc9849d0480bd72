// What a scanner would see of a map, against casting every beam at every wall.
#include "algorithms/map/parts/map_view.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/scan_builder.hpp"

namespace scanbench::mapping {
namespace {

TEST(MapView, SeesWhatCastingEveryBeamSees) {
  const std::vector<Segment> room = support::random_room(4);
  const SensorModel sensor = support::ring_sensor(361);
  const Pose2 pose(0.1, -0.2, 0.7);
  const support::OwnedScan cast = support::cast(sensor, {room.begin(), room.begin() + 4}, pose);
  const MapView view = view_of(std::span(room).first(4), pose, sensor);
  for (std::size_t i = 0; i < cast.ranges.size(); ++i) EXPECT_NEAR(view.ranges[i], cast.ranges[i], 1e-9) << i;
}

TEST(MapView, HasALineForEveryVisibleWallAndLabelsItsBeams) {
  const std::vector<Segment> room = support::box(-3, -2, 4, 2);
  const MapView view = view_of(room, {}, support::ring_sensor(360, 0.0));
  ASSERT_EQ(view.lines.lines.size(), 5u);  // the wall across the first beam is seen in two runs
  for (std::size_t i = 0; i < view.ranges.size(); ++i) {
    ASSERT_GE(view.lines.labels[i], 0);
    const LineFeature& line = view.lines.lines[static_cast<std::size_t>(view.lines.labels[i])];
    EXPECT_LE(line.first_beam, static_cast<int>(i));
    EXPECT_GE(line.last_beam, static_cast<int>(i));
  }
}

TEST(MapView, DoesNotSeeWallsFromBehind) {
  const std::vector<Segment> wall{{{-1, 1}, {1, 1}}};  // its free side looks up, away from the sensor
  for (const double range : view_of(wall, {}, support::ring_sensor(90)).ranges) EXPECT_EQ(range, kInf);
}

TEST(MapView, OfNothingIsEmpty) {
  const MapView view = view_of({}, {}, support::ring_sensor(90));
  EXPECT_EQ(view.ranges.size(), 90u);
  EXPECT_TRUE(view.lines.lines.empty());
}

}  // namespace
}  // namespace scanbench::mapping
