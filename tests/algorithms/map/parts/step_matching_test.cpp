// The match of a scan with the scan before it: wrong headings, scans that do not meet, and what mappers make of it.
#include "algorithms/map/parts/step_matching.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/registry.hpp"
#include "core/special_values.hpp"
#include "tests/support/aligning.hpp"
#include "tests/support/scan_builder.hpp"

namespace scanbench::mapping {
namespace {

// A room without symmetry, so that a heading is right or wrong.
std::vector<Segment> room() {
  auto walls = support::box(-4, -3, 5, 3.5);
  for (const Segment& s : support::polygon({{2, 1}, {3.2, 1.3}, {2.8, 2.4}, {1.9, 2.0}})) walls.push_back(s);
  for (const Segment& s : support::polygon({{-3, -2}, {-2.1, -2.2}, {-2.0, -0.9}})) walls.push_back(s);
  return walls;
}

support::OwnedScan seen(const Pose2& pose, const std::vector<Segment>& walls = room(), std::uint32_t frame = 0) {
  return support::with_noise(support::cast(support::ring_sensor(361), walls, pose), 0.01, 5, frame);
}

const Pose2 kFirst(0.5, -0.4, 0.3), kSecond(0.8, -0.2, 0.9);

support::ScanSeries two_scans(const std::vector<Segment>& second_room = room()) {
  support::ScanSeries series;
  series.add_extracted(seen(kFirst), "iepf");
  series.add_extracted(seen(kSecond, second_room, 1), "iepf");
  return series;
}

TEST(StepMatching, FindsAHeadingThatOdometryHasLost) {
  const auto series = two_scans();
  const auto scans = series.observations();
  const Pose2 slipped(0.85, -0.25, 0.9 - radians(40));
  StepMatching searching("icp", "step_matcher", radians(60)), trusting("icp", "step_matcher", 0.0);
  for (StepMatching* steps : {&searching, &trusting}) steps->found(scans[0], kFirst);
  const auto found = searching.pose(scans[1], slipped);
  ASSERT_TRUE(found);
  EXPECT_NEAR((found->translation() - kSecond.translation()).norm(), 0.0, 0.05);
  EXPECT_NEAR(wrap_angle(found->yaw() - kSecond.yaw()), 0.0, radians(1.5));
  const auto stuck = trusting.pose(scans[1], slipped);
  EXPECT_TRUE(!stuck || std::fabs(wrap_angle(stuck->yaw() - kSecond.yaw())) > radians(5));
}

TEST(StepMatching, GivesNoPoseWhereNothingSaysWhereTheScanIs) {
  const auto series = two_scans();
  const auto scans = series.observations();
  StepMatching steps("icp", "step_matcher", 0.0), none("none", "step_matcher", 0.0);
  EXPECT_FALSE(steps.pose(scans[1], kSecond)) << "there is no scan before";
  none.found(scans[0], kFirst);
  EXPECT_FALSE(none.pose(scans[1], kSecond));
  const auto other = two_scans(support::box(-30, -30, 40, 35));
  steps.found(scans[0], kFirst);
  EXPECT_FALSE(steps.pose(other.observations()[1], kSecond)) << "another place";
  for (const double range : {kInf, kNaN}) {
    support::ScanSeries empty;
    empty.add_extracted(support::constant_scan(support::ring_sensor(361), range), "iepf");
    EXPECT_FALSE(steps.pose(empty.observations()[0], kSecond));
    steps.found(empty.observations()[0], kFirst);
    EXPECT_FALSE(steps.pose(scans[1], kSecond)) << "the scan before is empty";
  }
}

TEST(StepMatching, OfAnUnknownMatcherNamesTheParameter) {
  try {
    StepMatching("ipc", "step_matcher", 0.0);
    FAIL() << "accepted";
  } catch (const ParamError& error) {
    EXPECT_NE(std::string(error.what()).find("'ipc'"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("plicp"), std::string::npos) << error.what();
  }
}

TEST(StepMatching, KeepsBothMappersOnTheirPathWhereWheelsSlip) {
  // Every second step of the odometry loses 35 degrees. The poses of the map are still those of the sensor.
  for (const std::string mapper : {"dse", "navigation_map"}) {
    const auto module = Registry<Mapper>::make(mapper, {{"step_matcher", "icp"}, {"search_deg", 60.0}});
    support::ScanSeries series;
    std::vector<Pose2> truth, odometry;
    for (int k = 0; k < 8; ++k) {
      truth.emplace_back(0.15 * k - 0.8, 0.05 * k - 0.5, 0.25 * k);
      const Pose2 slip(0, 0, k % 2 == 1 ? radians(-35) : 0.0);
      odometry.push_back(k == 0 ? truth[0]
                                : odometry.back() * (truth[truth.size() - 2].inverse() * truth.back()) * slip);
      series.add_extracted(seen(truth.back(), room(), static_cast<std::uint32_t>(k)), "iepf");
    }
    const auto scans = series.observations();
    Trace silent;
    for (std::size_t k = 0; k < scans.size(); ++k) {
      const Insertion step = module->insert(scans[k], odometry[k], silent);
      EXPECT_EQ(step.status, Status::converged) << mapper << " " << k << " " << step.message;
      EXPECT_NEAR((step.world_from_sensor.translation() - truth[k].translation()).norm(), 0.0, 0.05) << mapper << k;
      EXPECT_NEAR(wrap_angle(step.world_from_sensor.yaw() - truth[k].yaw()), 0.0, radians(1.5)) << mapper << k;
    }
  }
}

}  // namespace
}  // namespace scanbench::mapping
