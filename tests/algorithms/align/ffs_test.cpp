// All aligners: what must hold by mechanics, and what they say of input that they cannot align.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "algorithms/align/parts/outcome.hpp"
#include "core/contracts/force_field_trace.hpp"
#include "core/rng.hpp"
#include "tests/support/aligning.hpp"
#include "tests/support/matchers.hpp"
#include "tests/support/trace_recorder.hpp"

namespace scanbench {
namespace {

using support::align;
using support::cast;
using support::OwnedScan;
using support::ring_sensor;
using support::ScanSeries;

std::vector<Segment> room() {
  return support::polygon({{-3, -2}, {4, -2.5}, {4.6, 1.2}, {2.2, 2.9}, {-2.6, 2.2}});
}

std::vector<Pose2> path() {
  return {{0, 0, 0}, {0.7, -0.3, 0.4}, {1.6, 0.2, 1.2}, {2.1, 0.9, 2.5}, {-0.9, 0.8, -2.0}};
}

std::vector<Pose2> perturbed(std::vector<Pose2> poses, std::uint64_t seed) {
  CounterRng rng(seed, RngStream::pose);
  const auto within = [&](double most) { return most * (2 * rng.uniform() - 1); };
  for (Pose2& p : poses) p = p * Pose2(within(0.15), within(0.15), within(radians(4)));
  return poses;
}

ScanSeries scans_of(const std::vector<Segment>& walls, const std::vector<Pose2>& poses) {
  ScanSeries scans;
  for (const Pose2& p : poses) scans.add_exact(cast(ring_sensor(360), walls, p));
  return scans;
}

OwnedScan nothing() {
  return support::constant_scan(ring_sensor(360), kInf);
}

/// Largest relative error of positions [m] and headings [rad] against the truth, seen from the first scan.
std::pair<double, double> relative_error(const std::vector<Pose2>& poses, const std::vector<Pose2>& truth) {
  double shift = 0.0, turn = 0.0;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Pose2 off = (truth[0].inverse() * truth[k]).inverse() * (poses[0].inverse() * poses[k]);
    shift = std::max(shift, off.translation().norm());
    turn = std::max(turn, std::abs(off.yaw()));
  }
  return {shift, turn};
}

class AllToAll : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Aligners, AllToAll,
                         ::testing::Values("ffs", "virtual_scans", "simultaneous_icp", "point_to_line"),
                         [](const auto& test) { return test.param; });

TEST_P(AllToAll, BringScansOfARoomTogetherFromManyStarts) {
  const ScanSeries scans = scans_of(room(), path());
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto [shift, turn] =
        relative_error(align(GetParam(), scans, perturbed(path(), seed)).world_from_sensor, path());
    EXPECT_LT(shift, 0.02) << "seed " << seed;
    EXPECT_LT(turn, radians(0.5)) << "seed " << seed;
  }
}

TEST_P(AllToAll, KeepTheFirstPoseAndDoNotDependOnTheFrame) {
  const ScanSeries scans = scans_of(room(), path());
  const std::vector<Pose2> initial = perturbed(path(), 3);
  const Pose2 elsewhere(100, -40, 2.0);
  std::vector<Pose2> moved;
  for (const Pose2& p : initial) moved.push_back(elsewhere * p);
  const auto here = align(GetParam(), scans, initial).world_from_sensor;
  const auto there = align(GetParam(), scans, moved).world_from_sensor;
  EXPECT_EQ(here[0], initial[0]);
  for (std::size_t k = 0; k < here.size(); ++k)
    EXPECT_THAT(there[k].translation(), support::PointNear((elsewhere * here[k]).translation(), 1e-6));
}

TEST_P(AllToAll, ReportGroupsOfScansThatDoNotMeet) {
  ScanSeries scans;
  std::vector<Pose2> poses = path();
  for (const Pose2& p : path()) scans.add_exact(cast(ring_sensor(360), room(), p));
  for (const Pose2& p : path()) {
    scans.add_exact(cast(ring_sensor(360), room(), p));
    poses.push_back(Pose2(50, 0, 0) * p);
  }
  const Alignment result = align(GetParam(), scans, poses);
  EXPECT_EQ(result.status, Status::degenerate);
  EXPECT_NE(result.message.find("2 groups of scans do not meet"), std::string::npos) << result.message;
}

TEST_P(AllToAll, NameTheEmptyScanAmongFullOnes) {
  ScanSeries scans;
  for (const Pose2& p : path()) scans.add_exact(cast(ring_sensor(360), room(), p));
  scans.add_exact(nothing());
  std::vector<Pose2> poses = path();
  poses.emplace_back(1, 1, 1);
  const Alignment result = align(GetParam(), scans, poses);
  EXPECT_EQ(result.status, Status::degenerate);
  EXPECT_NE(result.message.find("scan 5"), std::string::npos) << result.message;
}

TEST_P(AllToAll, ReturnTheGivenPosesOfScansWithoutOverlap) {
  ScanSeries scans;
  std::vector<Pose2> poses;
  for (int k = 0; k < 3; ++k) {
    scans.add_exact(cast(ring_sensor(360), room(), {}));
    poses.emplace_back(100.0 * k, 0, 0.1 * k);
  }
  const Alignment result = align(GetParam(), scans, poses);
  EXPECT_EQ(result.status, Status::no_match);
  EXPECT_EQ(result.world_from_sensor, poses);
  EXPECT_FALSE(result.message.empty());
}

TEST_P(AllToAll, RefusePosesThatAreNotFinite) {
  const ScanSeries scans = scans_of(room(), path());
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), kInf, 1e12}) {
    std::vector<Pose2> poses = path();
    poses[2] = Pose2::from_unit({bad, 0}, {1, 0});
    const Alignment result = align(GetParam(), scans, poses);
    EXPECT_EQ(result.status, Status::degenerate);
    EXPECT_NE(result.message.find("scan 2"), std::string::npos) << result.message;
  }
}

TEST_P(AllToAll, LeaveEqualScansWhereTheyAre) {
  const ScanSeries scans = scans_of(room(), std::vector<Pose2>(4, Pose2(0.3, 0.2, 0.1)));
  const std::vector<Pose2> poses(4, Pose2(1, 2, 0.5));
  const Alignment result = align(GetParam(), scans, poses);
  constexpr double kSettled = 1e-3 * 0.05;  // of sigma_end_m: below this movement a simulation ends
  for (const Pose2& p : result.world_from_sensor) {
    EXPECT_THAT(p.translation(), support::PointNear(Vec2(1, 2), kSettled));
    EXPECT_THAT(p.yaw(), support::AngleNear(0.5, kSettled));
  }
}

TEST_P(AllToAll, SayWhenTheIterationsWereUsedUp) {
  const bool simulates = GetParam() == "ffs" || GetParam() == "virtual_scans";
  const std::string limit = simulates ? "max_iterations" : "max_rounds";
  ParamSet params{{limit, std::int64_t{2}}};
  if (simulates) params.emplace("cooling_iterations", std::int64_t{2});
  const Alignment result = align(GetParam(), scans_of(room(), path()), perturbed(path(), 1), params);
  EXPECT_NE(result.status, Status::converged);
  EXPECT_NE(result.message.find("moved"), std::string::npos) << result.message;
}

TEST_P(AllToAll, LeaveNoScanAndOneScanWhereTheyAre) {
  EXPECT_EQ(align(GetParam(), {}, {}).status, Status::converged);
  const std::vector<Pose2> alone{{3, -4, 0.5}};
  const Alignment one = align(GetParam(), scans_of(room(), {{0, 0, 0}}), alone);
  EXPECT_EQ(one.status, Status::converged);
  EXPECT_EQ(one.world_from_sensor, alone);
}

TEST_P(AllToAll, FindNothingInScansWithoutLines) {
  ScanSeries scans;
  for (const Pose2& p : path()) {
    OwnedScan scan = cast(ring_sensor(360), room(), p);
    const std::size_t beams = scan.ranges.size();
    scans.add(std::move(scan), ScanLines{{}, std::vector<int>(beams, -1)});
  }
  const std::vector<Pose2> given = perturbed(path(), 4);
  const Alignment result = align(GetParam(), scans, given);
  EXPECT_EQ(result.status, Status::no_match);
  EXPECT_EQ(result.world_from_sensor, given);
  EXPECT_FALSE(result.message.empty());
}

TEST_P(AllToAll, NeverCallScansOfOneLongWallAligned) {
  // Nothing says how far the scans are along the wall.
  ScanSeries scans;
  std::vector<Pose2> poses;
  for (int k = 0; k < 4; ++k) {
    const Pose2 at(0.5 * k, 0, 0);
    scans.add_exact(cast(support::fan_sensor(181, radians(90)), {{{50, 2}, {-50, 2}}}, Pose2(at.x(), 0, kPi / 2)));
    poses.emplace_back(at.x() + 0.2 * (k % 2), 0.05 * (k % 3), kPi / 2);
  }
  const Alignment result = align(GetParam(), scans, poses);
  EXPECT_EQ(result.status, Status::degenerate);
  EXPECT_FALSE(result.message.empty());
}

TEST(VirtualScans, WithoutStrengthAreFfsBitForBit) {
  const ScanSeries scans = scans_of(room(), path());
  const std::vector<Pose2> initial = perturbed(path(), 7);
  const Alignment plain = align("ffs", scans, initial);
  const Alignment none = align("virtual_scans", scans, initial, {{"line_weight", 0.0}, {"rectangle_weight", 0.0}});
  EXPECT_EQ(none.status, plain.status);
  EXPECT_EQ(none.message, plain.message);
  EXPECT_EQ(none.world_from_sensor, plain.world_from_sensor);
  EXPECT_NE(align("virtual_scans", scans, initial).world_from_sensor, plain.world_from_sensor);
}

TEST(Movement, InAMessageHasOneSignificantDigit) {
  EXPECT_EQ(align::movement_text(0.00069277), "0.0007");
  EXPECT_EQ(align::movement_text(0.96), "1");
  EXPECT_EQ(align::movement_text(34.7), "30");
  EXPECT_EQ(align::movement_text(0.0), "0");
}

TEST(Ffs, ScheduleRefusesWhatDoesNotCool) {
  const auto make = [](const ParamSet& set) { Registry<Aligner>::make("ffs", set); };
  EXPECT_THROW(make({{"sigma_start_m", 0.0}}), ParamError);
  EXPECT_THROW(make({{"sigma_start_m", 0.1}, {"sigma_end_m", 0.2}}), ParamError);
  EXPECT_THROW(make({{"step_start", 1.0}, {"step_end", 2.0}}), ParamError);
  EXPECT_THROW(make({{"cooling_iterations", std::int64_t{50}}, {"max_iterations", std::int64_t{40}}}), ParamError);
}

TEST(Ffs, TracePotentialFallsAtOneRadiusAndStepNeverGrows) {
  support::TraceRecorder recorder("align");
  const ScanSeries scans = scans_of(room(), path());
  const auto module = Registry<Aligner>::make(
      "ffs", {{"sigma_start_m", 0.3}, {"sigma_end_m", 0.3}, {"step_start", 1.0}, {"step_end", 1.0}});
  module->align(scans.observations(), perturbed(path(), 2), recorder.trace);
  const auto rows = recorder.rows<force_field::IterationRow>();
  ASSERT_GT(rows.size(), 2u);
  EXPECT_LT(rows.back().potential, rows.front().potential) << "potential";
  for (std::size_t k = 1; k < rows.size(); ++k) EXPECT_LE(rows[k].step, rows[k - 1].step) << "dt^2 / 2";
}

}  // namespace
}  // namespace scanbench
