// Alignment of a scan with the map: by end points, not at all, by a registered matcher.
#include "algorithms/map/dse/alignment.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/registry.hpp"
#include "tests/support/aligning.hpp"
#include "tests/support/scan_builder.hpp"

namespace scanbench::mapping::dse {
namespace {

/// Knows the motion: what a beam along x sees nearer in the current scan is how far the sensor went.
class AlongX final : public ScanMatcher {
 public:
  using Params = NoParams;
  explicit AlongX(const Params&) {}
  Match match(const Observation& reference, const Observation& current, const Pose2& guess, Trace&) const override {
    Match found;
    found.reference_from_current = guess * Pose2(reference.scan.ranges[0] - current.scan.ranges[0], 0, 0);
    if (!(found.reference_from_current.x() < 1.0))
      found = {.status = Status::no_match, .reference_from_current = guess};
    return found;
  }
};
SCANBENCH_REGISTER(ScanMatcher, AlongX, {.name = "test_along_x", .summary = "of the tests", .reference = "none"});

const std::vector<Segment>& room() {
  static const std::vector<Segment> walls = support::box(-3, -2, 4, 2);
  return walls;
}

struct Scene {
  explicit Scene(const Pose2& pose) {
    series.add_exact(support::cast(support::ring_sensor(361, 0.0), room(), pose));
    for (const LineFeature& line : series.observations().front().lines.lines)
      scan.push_back({.segment = line.segment, .members = 1, .points = 10});
    for (const Segment& wall : room()) map.push_back({.segment = wall, .members = 1, .points = 10});
  }
  Registration align(const std::string& method, const Pose2& predicted) const {
    return MapAligner(method, {}, {}).align(series.observations().front(), scan, map, predicted);
  }
  support::ScanSeries series;
  std::vector<Stroke> scan, map;
};

TEST(MapAligner, EndPointsFindThePoseOfAnExactScan) {
  const Scene scene({0.2, 0.1, 0.05});
  const Registration found = scene.align("end_points", {0.3, 0.0, 0.02});
  EXPECT_EQ(found.status, Status::converged);
  EXPECT_NEAR((found.map_from_sensor.translation() - Vec2(0.2, 0.1)).norm(), 0.0, 1e-6);
  EXPECT_NEAR(found.map_from_sensor.yaw(), 0.05, 1e-6);
}

TEST(MapAligner, NoneTakesThePredictedPose) {
  const Registration found = Scene({0.2, 0.1, 0.05}).align("none", {0.3, 0.0, 0.02});
  EXPECT_EQ(found.status, Status::converged);
  EXPECT_TRUE(found.map_from_sensor == Pose2(0.3, 0.0, 0.02));
}

TEST(MapAligner, AMatcherGetsTheMapAsAScanFromThePredictedPose) {
  const Registration found = Scene({0.25, 0, 0}).align("test_along_x", {0.1, 0, 0});
  EXPECT_EQ(found.status, Status::converged);
  EXPECT_NEAR(found.map_from_sensor.x(), 0.25, 1e-9);
}

TEST(MapAligner, AMatcherThatFindsNothingLeavesThePrediction) {
  const Registration none = Scene({3.5, 0, 0}).align("test_along_x", {-2.5, 0, 0});
  EXPECT_EQ(none.status, Status::no_match);
  EXPECT_TRUE(none.map_from_sensor == Pose2(-2.5, 0, 0));
}

TEST(MapAligner, RefusesAnUnknownMethodAndNamesTheKnownOnes) {
  try {
    MapAligner("imagined", {}, {});
    FAIL() << "an unknown method was accepted";
  } catch (const ParamError& error) {
    EXPECT_EQ(error.param(), "alignment");
    EXPECT_THAT(error.what(), ::testing::HasSubstr("end_points, none"));
  }
}

}  // namespace
}  // namespace scanbench::mapping::dse
