// Every registered scan matcher, with its defaults, on scans that break careless ones. Lines are those of `optimal`.
#include <cmath>
#include <map>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "core/modules.hpp"
#include "core/registry.hpp"
#include "harness/study/conform/matcher_checks.hpp"
#include "tests/support/aligning.hpp"
#include "tests/support/matchers.hpp"
#include "tests/support/scan_builder.hpp"

namespace scanbench {
namespace {

using support::AngleNear;
using support::cast;
using support::constant_scan;
using support::kInf;
using support::kNaN;
using support::OwnedScan;
using support::PointNear;
using support::ring_sensor;
using support::ScanSeries;
using support::with_noise;

// Matchers that do not find the exact pose of scans without noise from two places, and why.
const std::map<std::string, std::string> kNotExact = {
    {"icp", "two scans of a wall have no points in common"},
};

std::vector<Segment> matcher_room() {
  auto walls = support::box(-3, -2, 4, 2.5);
  for (const Segment& s : support::polygon({{2, 1}, {2.6, 1.2}, {2.4, 1.8}, {1.8, 1.6}})) walls.push_back(s);
  return walls;
}

std::vector<Segment> corridor() {
  return {{{-60, -1}, {60, -1}}, {{60, 1}, {-60, 1}}};
}

OwnedScan seen(const std::vector<Segment>& walls, const Pose2& pose, double sigma_m = 0.0, std::uint32_t frame = 0) {
  OwnedScan scan = cast(ring_sensor(360), walls, pose);
  for (double& r : scan.ranges)
    if (r > 30.0) r = kInf;
  return sigma_m > 0 ? with_noise(scan, sigma_m, 5, frame) : scan;
}

double off(const Pose2& found, const Pose2& expected) {
  const Pose2 difference = expected.inverse() * found;
  return std::hypot(difference.translation().norm(), difference.yaw());
}

class MatcherConformance : public ::testing::TestWithParam<std::string> {
 protected:
  Match match(const OwnedScan& reference, const OwnedScan& current, const Pose2& guess) const {
    ScanSeries scans;
    scans.add_extracted(reference, "optimal");
    scans.add_extracted(current, "optimal");
    return match(scans, guess);
  }
  Match match(const ScanSeries& scans, const Pose2& guess) const {
    const std::vector<Observation> both = scans.observations();
    Trace silent;
    const Match result = module_->match(both[0], both[1], guess, silent);
    EXPECT_TRUE(result.reference_from_current.translation().allFinite());
    EXPECT_TRUE(std::isfinite(result.reference_from_current.yaw()));
    EXPECT_TRUE(result.covariance.allFinite());
    EXPECT_LT((result.covariance - result.covariance.transpose()).norm(), 1e-9 * (1 + result.covariance.norm()));
    if (result.status == Status::no_match) {
      EXPECT_EQ(result.reference_from_current, guess);
      EXPECT_TRUE(result.covariance.isZero(0.0));
    }
    return result;
  }
  std::unique_ptr<ScanMatcher> module_ = Registry<ScanMatcher>::make(GetParam());
};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(MatcherConformance);
INSTANTIATE_TEST_SUITE_P(All, MatcherConformance, ::testing::ValuesIn(Registry<ScanMatcher>::names()),
                         [](const auto& test) { return test.param; });

TEST_P(MatcherConformance, TheChecksOfConformArePassed) {
  const auto& entry = *Registry<ScanMatcher>::find(GetParam());
  for (const auto& check : study::conform::matcher_checks()) {
    SCOPED_TRACE(check.name);
    study::conform::Findings findings;
    check.run({entry.params, entry.make}, findings);
    for (const auto& fault : findings.faults()) ADD_FAILURE() << fault;
  }
}

TEST_P(MatcherConformance, AScanWithoutReturnsOrBeamsDoesNotMatch) {
  const OwnedScan full = seen(matcher_room(), {});
  const Pose2 guess(0.1, 0.2, 0.3);
  for (const double nothing : {kInf, -kInf, kNaN, 0.0, -1.0}) {
    const OwnedScan empty = constant_scan(ring_sensor(360), nothing);
    EXPECT_EQ(match(empty, empty, guess).status, Status::no_match);
    EXPECT_EQ(match(full, empty, guess).status, Status::no_match);
    EXPECT_EQ(match(empty, full, guess).status, Status::no_match);
  }
  const OwnedScan no_beams = constant_scan(support::fan_sensor(0, 1.0), 1.0);
  EXPECT_EQ(match(no_beams, no_beams, guess).status, Status::no_match);
  EXPECT_EQ(match(full, no_beams, guess).status, Status::no_match);
}

TEST_P(MatcherConformance, FaultyReadingsAmongGoodOnesAreAnswered) {
  const Pose2 step(0.1, 0.05, 0.03);
  for (const double reading : {kNaN, kInf, -kInf, 0.0, -1.0, 1e300, 1e-300}) {
    OwnedScan reference = seen(matcher_room(), {}), current = seen(matcher_room(), step);
    for (std::size_t i = 0; i < 360; i += 3) reference.ranges[i] = current.ranges[i + 1] = reading;
    match(reference, current, {});
    match(reference, constant_scan(ring_sensor(360), reading), {});
  }
}

TEST_P(MatcherConformance, FewReturnsAreAnswered) {
  const OwnedScan full = seen(matcher_room(), {});
  for (int returns = 1; returns <= 5; ++returns) {
    OwnedScan few = constant_scan(ring_sensor(360), kInf);
    for (int i = 0; i < returns; ++i) few.ranges[static_cast<std::size_t>(60 + 3 * i)] = 2.0 + 0.1 * i;
    match(few, few, {});
    match(full, few, {});
    match(few, full, {});
  }
}

TEST_P(MatcherConformance, EqualPointsAreAnswered) {
  const OwnedScan one_ray = constant_scan(support::fan_sensor(50, 0.0), 2.0);
  const OwnedScan one_place = constant_scan(ring_sensor(360), 1e-12);
  match(one_ray, one_ray, {});
  match(one_place, one_place, {});
  match(one_place, seen(matcher_room(), {}), {});
}

TEST_P(MatcherConformance, AScanMatchesItselfExactly) {
  for (const double sigma_m : {0.0, 0.03}) {
    const OwnedScan full = seen(matcher_room(), {0, 0, 0.2}, sigma_m);
    const Match result = match(full, full, {});
    EXPECT_EQ(result.status, Status::converged);
    EXPECT_LT(off(result.reference_from_current, {}), 1e-9);
  }
}

TEST_P(MatcherConformance, AScanMatchesItselfFromAWrongGuess) {
  const OwnedScan full = seen(matcher_room(), {0, 0, 0.2});
  const Match result = match(full, full, {0.03, -0.02, 0.02});
  EXPECT_EQ(result.status, Status::converged);
  EXPECT_LT(off(result.reference_from_current, {}), kNotExact.contains(GetParam()) ? 3e-2 : 1e-6);
}

TEST_P(MatcherConformance, ARoomWithoutNoiseGivesThePose) {
  const std::vector<Pose2> steps{{0.15, 0.05, 0.1}, {-0.1, 0.2, -0.15}, {0.25, 0, 0.05}, {0, 0, 0.2}};
  for (const Pose2& step : steps) {
    const Match result = match(seen(matcher_room(), {}), seen(matcher_room(), step), step * Pose2(0.03, -0.03, 0.02));
    EXPECT_NE(result.status, Status::degenerate);
    EXPECT_NE(result.status, Status::no_match);
    EXPECT_LT(off(result.reference_from_current, step), kNotExact.contains(GetParam()) ? 2e-2 : 1e-6);
  }
}

TEST_P(MatcherConformance, ACornerWithoutNoiseGivesThePose) {
  const std::vector<Segment> corner{{{3, -4}, {3, 2}}, {{3, 2}, {-4, 2}}};
  const Pose2 step(0.1, -0.05, 0.05);
  const Match result = match(seen(corner, {}), seen(corner, step), step * Pose2(0.02, 0.02, -0.01));
  EXPECT_NE(result.status, Status::degenerate);
  EXPECT_LT(off(result.reference_from_current, step), kNotExact.contains(GetParam()) ? 5e-2 : 1e-6);
}

TEST_P(MatcherConformance, OneWallIsDegenerateAlongIt) {
  const std::vector<Segment> wall{{{-60, 2}, {60, 2}}};
  for (const double sigma_m : {0.0, 0.01, 0.05}) {
    const Pose2 guess(0.12, 0.0, 0.0);
    const Match result = match(seen(wall, {}, sigma_m, 0), seen(wall, {0.1, 0.05, 0.05}, sigma_m, 1), guess);
    ASSERT_EQ(result.status, Status::degenerate) << sigma_m;
    EXPECT_NEAR(result.reference_from_current.x(), guess.x(), 0.02) << "the open motion is that of the guess";
    EXPECT_NEAR(result.reference_from_current.y(), 0.05, 5 * sigma_m + 1e-3);
  }
}

TEST_P(MatcherConformance, ACorridorWithoutEndIsDegenerateAndTheCovarianceNamesItsDirection) {
  for (const double sigma_m : {0.0, 0.01, 0.05})
    for (std::uint32_t k = 0; k < 10; ++k) {
      const Pose2 pose(0.3 * k, 0.4 - 0.08 * k, 0.6 * k), step(0.1, 0.03, 0.05);
      const Match result = match(seen(corridor(), pose, sigma_m, 2 * k),
                                 seen(corridor(), pose * step, sigma_m, 2 * k + 1), step * Pose2(0.04, -0.04, 0.02));
      ASSERT_EQ(result.status, Status::degenerate) << sigma_m << " " << k;
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(result.covariance);
      EXPECT_NEAR(std::sqrt(eigen.eigenvalues()(2)), kOpenMotionM, 0.01 * kOpenMotionM);
      EXPECT_LT(std::sqrt(eigen.eigenvalues()(1)), 0.1);
      const Vec2 open = eigen.eigenvectors().col(2).head<2>();
      EXPECT_THAT(std::atan2(open.y(), open.x()), support::DirectionNear(-pose.yaw(), radians(2.0)));
    }
}

TEST_P(MatcherConformance, ScansOfDifferentPlacesDoNotMatch) {
  const OwnedScan here = seen(support::box(-2, -2, 2, 2), {}, 0.01);
  const OwnedScan there = seen(support::box(-9, -8, 10, 9), {}, 0.01, 1);
  EXPECT_EQ(match(here, there, {}).status, Status::no_match);
}

TEST_P(MatcherConformance, TheMatchTurnsWithTheReferenceSensor) {
  const Pose2 step(0.1, 0.05, 0.06), error(0.03, -0.03, 0.02);
  const OwnedScan current = seen(matcher_room(), step, 0.02, 1);
  const Match before = match(seen(matcher_room(), {}, 0.02), current, step * error);
  // The same returns in a reference frame that is turned by -0.7.
  const OwnedScan turned = support::turned(seen(matcher_room(), {}, 0.02), -0.7);
  const Pose2 turn(0, 0, -0.7);
  const Match after = match(turned, current, turn * step * error);
  EXPECT_EQ(before.status, after.status);
  const double tolerance = kNotExact.contains(GetParam()) ? 1e-4 : 1e-5;
  EXPECT_LT(off(after.reference_from_current, turn * before.reference_from_current), tolerance);
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  rotation.topLeftCorner<2, 2>() << turn.cos(), -turn.sin(), turn.sin(), turn.cos();
  const Eigen::Matrix3d expected = rotation * before.covariance * rotation.transpose();
  EXPECT_LT((after.covariance - expected).norm(), 1e-2 * expected.norm());
}

TEST_P(MatcherConformance, TheCovarianceHoldsTheErrorsOfARoom) {
  // Mean of e' C^-1 e over 40 pairs: 3 +- 0.39 (one standard deviation) where covariances are honest.
  double sum = 0.0;
  int count = 0;
  for (std::uint32_t k = 0; k < 40; ++k) {
    const Pose2 pose(-1.0 + 0.05 * k, -1.0 + 0.03 * k, 0.3 * k), step(0.1, 0.05, 0.05);
    const Match result = match(seen(matcher_room(), pose, 0.02, 2 * k),
                               seen(matcher_room(), pose * step, 0.02, 2 * k + 1), step * Pose2(0.03, -0.03, 0.02));
    if (result.status == Status::degenerate || result.status == Status::no_match) continue;
    const Vec2 shift = result.reference_from_current.translation() - step.translation();
    const Eigen::Vector3d e(shift.x(), shift.y(), wrap_angle(result.reference_from_current.yaw() - step.yaw()));
    sum += e.dot(result.covariance.inverse() * e);
    ++count;
  }
  EXPECT_GE(count, 39);
  EXPECT_LT(sum / count, 5.0);
  EXPECT_GT(sum / count, kNotExact.contains(GetParam()) ? 0.3 : 1.8);
}

TEST_P(MatcherConformance, TheAnswerIsTheSameTwiceAndTheInputIsUntouched) {
  ScanSeries scans;
  const OwnedScan a = seen(matcher_room(), {}, 0.02, 0), b = seen(matcher_room(), {0.1, 0.05, 0.03}, 0.02, 1);
  scans.add_extracted(a, "optimal");
  scans.add_extracted(b, "optimal");
  const Match first = match(scans, {}), second = match(scans, {});
  const std::vector<Observation> both = scans.observations();
  EXPECT_TRUE(std::ranges::equal(both[0].scan.ranges, a.ranges));
  EXPECT_TRUE(std::ranges::equal(both[1].scan.ranges, b.ranges));
  Trace silent;
  const Match other = Registry<ScanMatcher>::make(GetParam())->match(both[0], both[1], {}, silent);
  for (const Match& again : {second, other}) {
    EXPECT_EQ(first.status, again.status);
    EXPECT_EQ(first.reference_from_current, again.reference_from_current);
    EXPECT_EQ(first.covariance, again.covariance);
  }
}

TEST_P(MatcherConformance, LinesWithoutCovarianceAndNoLinesAreAnswered) {
  const Pose2 step(0.1, 0.05, 0.03);
  ScanSeries extracted, none;
  for (const Pose2& pose : {Pose2(), step}) {
    extracted.add_extracted(seen(matcher_room(), pose, 0.01), "iepf");
    none.add(seen(matcher_room(), pose, 0.01), {.lines = {}, .labels = std::vector<int>(360, -1)});
  }
  const Match by_lines = match(extracted, {});
  EXPECT_NE(by_lines.status, Status::no_match);
  EXPECT_LT(off(by_lines.reference_from_current, step), 0.05);
  match(none, {});
}

}  // namespace
}  // namespace scanbench
