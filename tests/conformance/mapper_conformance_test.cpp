// Every registered mapper, with its defaults, on series of scans that break careless ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/modules.hpp"
#include "core/registry.hpp"
#include "core/special_values.hpp"
#include "harness/study/conform/mapper_checks.hpp"
#include "tests/support/aligning.hpp"
#include "tests/support/matchers.hpp"
#include "tests/support/scan_builder.hpp"

namespace scanbench {
namespace {

using support::SegmentNear;

const std::vector<Segment>& room() {
  static const std::vector<Segment> walls = support::box(-4, -3, 5, 3.5);
  return walls;
}

/// Stops of a sensor on an arc through the room.
Pose2 stop(int k) {
  return {0.15 * k - 1.0, 0.05 * k, 0.08 * k};
}

support::OwnedScan seen_from(const Pose2& pose, const std::vector<Segment>& walls, std::uint32_t frame) {
  return support::with_noise(support::cast(support::ring_sensor(361), walls, pose), 0.01, 5, frame);
}

support::ScanSeries drive(int scans) {
  support::ScanSeries series;
  for (int k = 0; k < scans; ++k)
    series.add_extracted(seen_from(stop(k), room(), static_cast<std::uint32_t>(k)), "iepf");
  return series;
}

struct Mapped {
  std::vector<Insertion> steps;
  std::vector<LineMap> maps;  ///< after each step
};

class MapperConformance : public ::testing::TestWithParam<std::string> {
 protected:
  static std::unique_ptr<Mapper> make() { return Registry<Mapper>::make(GetParam()); }

  static Mapped map(const support::ScanSeries& series, const std::vector<Pose2>& guesses) {
    const auto mapper = make();
    Mapped result;
    Trace silent;
    const auto observations = series.observations();
    for (std::size_t k = 0; k < observations.size(); ++k) {
      result.steps.push_back(mapper->insert(observations[k], guesses[k], silent));
      result.maps.push_back(mapper->map());
      check(result.steps.back(), result.maps.back());
    }
    return result;
  }

  static void check(const Insertion& step, const LineMap& map) {
    EXPECT_TRUE(step.world_from_sensor.translation().allFinite());
    EXPECT_TRUE(std::isfinite(step.world_from_sensor.yaw()));
    EXPECT_GE(step.lines, static_cast<int>(map.lines.size())) << "a map may hide lines, not invent them";
    if (step.status == Status::no_match) {
      EXPECT_NE(step.message, "") << "a scan that does not fit is explained";
    }
    for (const MapLine& line : map.lines) {
      EXPECT_TRUE(line.segment.a.allFinite() && line.segment.b.allFinite());
      EXPECT_GT(line.segment.length(), 0.0);
      EXPECT_TRUE(line.covariance.allFinite());
      EXPECT_GE(line.members, 1);
      EXPECT_GE(line.points, 0);
    }
  }

  static std::vector<Pose2> guesses(int scans, const Pose2& motion = {}) {
    std::vector<Pose2> poses;
    for (int k = 0; k < scans; ++k) poses.push_back(motion * stop(k));
    return poses;
  }
};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(MapperConformance);
INSTANTIATE_TEST_SUITE_P(All, MapperConformance, ::testing::ValuesIn(Registry<Mapper>::names()),
                         [](const auto& test) { return test.param; });

/// Length of the room's walls within `near` of a map line, as a share.
double covered(const LineMap& map, double near) {
  int hits = 0, all = 0;
  for (const Segment& wall : room())
    for (double at = 0.05; at < wall.length(); at += 0.1, ++all) {
      const Vec2 p = wall.a + at * wall.direction();
      hits += std::ranges::any_of(map.lines, [&](const MapLine& l) { return distance(p, l.segment) <= near; }) ? 1 : 0;
    }
  return static_cast<double>(hits) / all;
}

TEST_P(MapperConformance, TheChecksOfConformArePassed) {
  const auto& entry = *Registry<Mapper>::find(GetParam());
  for (const auto& check : study::conform::mapper_checks()) {
    SCOPED_TRACE(check.name);
    study::conform::Findings findings;
    check.run({entry.params, entry.make}, findings);
    for (const auto& fault : findings.faults()) ADD_FAILURE() << fault;
  }
}

TEST_P(MapperConformance, AMapIsReadyAfterEveryScan) {
  const Mapped mapped = map(drive(8), guesses(8));
  for (const LineMap& lines : mapped.maps) EXPECT_GT(covered(lines, 0.05), 0.9);
}

TEST_P(MapperConformance, TheMapOfARoomHasAboutALineAWall) {
  const Mapped mapped = map(drive(8), guesses(8));
  EXPECT_LE(mapped.maps.back().lines.size(), 3 * room().size());
  for (const Insertion& step : mapped.steps) EXPECT_EQ(step.status, Status::converged) << step.message;
}

TEST_P(MapperConformance, TheSameScansGiveTheSameMap) {
  const Mapped first = map(drive(6), guesses(6)), second = map(drive(6), guesses(6));
  ASSERT_EQ(first.maps.back().lines.size(), second.maps.back().lines.size());
  for (std::size_t i = 0; i < first.maps.back().lines.size(); ++i)
    EXPECT_TRUE(first.maps.back().lines[i].segment == second.maps.back().lines[i].segment);
  for (std::size_t k = 0; k < first.steps.size(); ++k)
    EXPECT_TRUE(first.steps[k].world_from_sensor == second.steps[k].world_from_sensor);
}

TEST_P(MapperConformance, MovingAllPosesMovesTheMap) {
  const Pose2 motion(30, -12, 2.2);
  const Mapped still = map(drive(6), guesses(6)), moved = map(drive(6), guesses(6, motion));
  ASSERT_EQ(still.maps.back().lines.size(), moved.maps.back().lines.size());
  for (std::size_t i = 0; i < still.maps.back().lines.size(); ++i)
    EXPECT_THAT(moved.maps.back().lines[i].segment, SegmentNear(motion * still.maps.back().lines[i].segment, 1e-6));
}

TEST_P(MapperConformance, TheSameScanTwiceAddsNoWalls) {
  support::ScanSeries series;
  for (int k = 0; k < 2; ++k) series.add_extracted(seen_from(stop(0), room(), 0), "iepf");
  const Mapped mapped = map(series, {stop(0), stop(0)});
  EXPECT_LE(mapped.maps[1].lines.size(), mapped.maps[0].lines.size());
  // Walls of the map are not the lines of the scan, but nearer to them than the noise of 1 cm.
  EXPECT_NEAR((mapped.steps[1].world_from_sensor.translation() - stop(0).translation()).norm(), 0.0, 5e-3);
}

TEST_P(MapperConformance, AScanWithoutReturnsIsReportedAndLeavesTheMapAsItIs) {
  for (const double range : {kInf, kNaN, -kInf}) {
    support::ScanSeries series;
    series.add_extracted(seen_from(stop(0), room(), 0), "iepf");
    series.add_extracted(support::constant_scan(support::ring_sensor(361), range), "iepf");
    series.add_extracted(seen_from(stop(1), room(), 1), "iepf");
    const Mapped mapped = map(series, guesses(3));
    EXPECT_EQ(mapped.steps[1].status, Status::no_match);
    EXPECT_EQ(mapped.maps[1].lines.size(), mapped.maps[0].lines.size());
    EXPECT_NE(mapped.steps[2].status, Status::no_match);
  }
}

TEST_P(MapperConformance, AnEmptyScanFirstIsNoMapAndTheNextOneIsTheMap) {
  support::ScanSeries series;
  series.add_extracted(support::constant_scan(support::ring_sensor(361), kInf), "iepf");
  series.add_extracted(seen_from(stop(1), room(), 1), "iepf");
  const Mapped mapped = map(series, guesses(2));
  EXPECT_TRUE(mapped.maps[0].lines.empty());
  EXPECT_GT(covered(mapped.maps[1], 0.05), 0.9);
}

TEST_P(MapperConformance, AJumpInPoseDoesNotSpoilTheMap) {
  auto poses = guesses(6);
  for (std::size_t k = 3; k < 6; ++k) poses[k] = Pose2(1.4, 1.1, 0.6) * poses[k];  // the guesses, not the sensor
  const Mapped mapped = map(drive(6), poses);
  bool reported = false;
  for (const Insertion& step : mapped.steps) reported = reported || step.status == Status::no_match;
  const bool mended = std::ranges::all_of(mapped.maps.back().lines, [](const MapLine& line) {
    return std::ranges::any_of(room(), [&](const Segment& wall) {
      return std::max(distance(line.segment.a, wall), distance(line.segment.b, wall)) < 0.1;
    });
  });
  EXPECT_TRUE(reported || mended) << "a wrong map is called good";
  EXPECT_TRUE(mended) << "scans that do not fit are in the map";
}

TEST_P(MapperConformance, AMapOfOneWallIsOneLineAndSaysThatAMotionIsOpen) {
  support::ScanSeries series;
  const std::vector<Segment> wall{{{-30, -1}, {30, -1}}};
  for (int k = 0; k < 3; ++k)
    series.add_extracted(support::cast(support::fan_sensor(181, radians(120)), wall, {0.1 * k, 0, -kPi / 2}), "iepf");
  std::vector<Pose2> poses;
  for (int k = 0; k < 3; ++k) poses.emplace_back(0.1 * k, 0, -kPi / 2);
  const Mapped mapped = map(series, poses);
  EXPECT_EQ(mapped.maps.back().lines.size(), 1u);
  EXPECT_EQ(mapped.steps.back().status, Status::degenerate);
  EXPECT_NE(mapped.steps.back().message, "");
}

TEST_P(MapperConformance, TimeThatRunsBackwardsIsAnswered) {
  const support::ScanSeries series = drive(3);
  const auto mapper = make();
  Trace silent;
  const auto observations = series.observations();
  for (std::size_t k = 0; k < 3; ++k) {
    const Scan late{observations[k].scan.sensor, observations[k].scan.ranges, -1.0 * static_cast<double>(k)};
    check(mapper->insert({late, observations[k].lines}, stop(static_cast<int>(k)), silent), mapper->map());
  }
  EXPECT_GT(covered(mapper->map(), 0.05), 0.9);
}

TEST_P(MapperConformance, LinesThatAreNotFiniteOrHaveNoLengthAreNotInTheMap) {
  const support::ScanSeries series = drive(1);
  const Observation good = series.observations().front();
  ScanLines lines = good.lines;
  for (const double bad : {kNaN, kInf}) {
    LineFeature line = lines.lines.front();
    line.segment.b.x() = bad;
    lines.lines.push_back(line);
  }
  LineFeature point = lines.lines.front();
  point.segment.b = point.segment.a;
  lines.lines.push_back(point);
  const auto mapper = make();
  Trace silent;
  check(mapper->insert({good.scan, lines}, {}, silent), mapper->map());
}

TEST_P(MapperConformance, LinesWithoutScansAreMapped) {
  SensorModel none;
  const std::vector<double> no_ranges;
  ScanLines lines;
  for (const Segment& wall : room())
    lines.lines.push_back({.segment = wall, .line = line_through(wall.a, wall.b), .covariance = {}});
  const auto mapper = make();
  Trace silent;
  for (int k = 0; k < 2; ++k) check(mapper->insert({{none, no_ranges, 0.0}, lines}, {}, silent), mapper->map());
  EXPECT_EQ(mapper->map().lines.size(), room().size());
}

TEST_P(MapperConformance, WithoutOdometryASlowDriveIsMapped) {
  const support::ScanSeries series = drive(6);
  const Mapped mapped = map(series, std::vector<Pose2>(6));  // a log without poses gives the identity
  EXPECT_LE(mapped.maps.back().lines.size(), 3 * room().size());
  const Pose2 moved = mapped.steps.back().world_from_sensor;
  const Pose2 truth = stop(0).inverse() * stop(5);
  EXPECT_NEAR((moved.translation() - truth.translation()).norm(), 0.0, 0.05);
}

}  // namespace
}  // namespace scanbench
