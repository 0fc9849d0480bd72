// optimal_match: what the guess and the walls say about each other.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "algorithms/match/parts/pose_information.hpp"
#include "core/registry.hpp"
#include "tests/support/scan_builder.hpp"

namespace scanbench::matching {
namespace {

using support::box;
using support::cast;
using support::fan_sensor;
using support::OwnedScan;
using support::polygon;
using support::with_noise;

/// A room of 17 m by 10 m with boxes that stand 1.6 m apart and are turned at random: from box to box the walls look
/// alike.
std::vector<Segment> cluttered_room() {
  std::vector<Segment> walls = box(0, 0, 17, 10);
  CounterRng rng(3, RngStream::pose);
  for (double x = 2.0; x < 16.0; x += 1.6)
    for (const double y : {1.5, 3.1, 6.9, 8.5}) {
      const Pose2 place(x, y, kPi * rng.uniform());
      const double half = 0.2 + 0.1 * rng.uniform();
      for (const Segment& side : polygon({place * Vec2(-half, half), place * Vec2(half, half),
                                          place * Vec2(half, -half), place * Vec2(-half, -half)}))
        walls.push_back(side);
    }
  return walls;
}

TEST(OptimalMatch, StatesNoWrongPoseFromGuessesSeveralStandardDeviationsOff) {
  const std::vector<Segment> walls = cluttered_room();
  const SensorModel sensor = fan_sensor(451, radians(270));
  const auto extractor = Registry<LineExtractor>::make("optimal");
  const auto matcher = Registry<ScanMatcher>::make("optimal_match");
  Trace silent;
  CounterRng rng(1, RngStream::odometry);
  const auto normal = [&] { return rng.normal(); };
  int stated = 0;
  for (std::uint32_t k = 0; k < 60; ++k) {
    const Pose2 from(2.0 + 0.2 * k, 5.0, 0.1 * normal());
    const Pose2 motion(0.2, 0.05 * normal(), 0.1 * normal());
    const OwnedScan reference = with_noise(cast(sensor, walls, from), 0.05, 1, 2 * k);
    const OwnedScan current = with_noise(cast(sensor, walls, from * motion), 0.05, 1, 2 * k + 1);
    const ScanLines there = extractor->extract(reference.view(), silent);
    const ScanLines here = extractor->extract(current.view(), silent);
    // The parameters state 0.1 m and 3 degrees.
    const Pose2 guess = moved(motion, {0.2 * normal(), 0.2 * normal(), radians(8.0) * normal()});
    const Match found = matcher->match({reference.view(), there}, {current.view(), here}, guess, silent);
    if (found.status != Status::converged && found.status != Status::max_iterations) continue;
    ++stated;
    const Motion error = motion_between(motion, found.reference_from_current);
    EXPECT_LT(error.head<2>().norm(), 0.06) << "pair " << k;
    EXPECT_LT(std::fabs(error.z()), radians(0.5)) << "pair " << k;
  }
  EXPECT_GE(stated, 57);
}

/// A wall from a to b, known to `sigma_m` and `sigma_rad`.
LineFeature wall(Vec2 a, Vec2 b, double sigma_m, double sigma_rad = 0.001) {
  LineFeature feature;
  feature.segment = {a, b};
  feature.line = line_through(a, b);
  feature.covariance = Eigen::Vector2d(sigma_m * sigma_m, sigma_rad * sigma_rad).asDiagonal().toDenseMatrix();
  return feature;
}

/// Walls that two scans show from one place; the parameters state 0.1 m and 3 degrees for the guess.
Match match_walls(const std::vector<LineFeature>& reference, const std::vector<LineFeature>& current,
                  const Pose2& guess) {
  const SensorModel sensor = fan_sensor(3, 1.0);
  const OwnedScan none{sensor, {kInf, kInf, kInf}, {}};
  const auto lines = [](const std::vector<LineFeature>& walls) {
    ScanLines result;
    result.lines = walls;
    result.labels = {-1, -1, -1};
    return result;
  };
  const ScanLines there = lines(reference), here = lines(current);
  Trace silent;
  return Registry<ScanMatcher>::make("optimal_match")->match({none.view(), there}, {none.view(), here}, guess, silent);
}

Match match_with_itself(const std::vector<LineFeature>& walls, const Pose2& guess) {
  return match_walls(walls, walls, guess);
}

const std::vector<LineFeature> kCorridor{wall({-4, 1}, {4, 1}, 0.001), wall({4, -1}, {-4, -1}, 0.001)};

// The corridor, and a wall across it.
Match match_with_a_wall_across(double sigma_m, const Pose2& guess) {
  std::vector<LineFeature> walls = kCorridor;
  walls.push_back(wall({5, 1}, {5, -1}, sigma_m));
  return match_with_itself(walls, guess);
}

TEST(OptimalMatch, LeavesOpenWhatTheWallsKnowLessWellThanTheGuess) {
  const Pose2 guess(0.05, 0.01, 0.0);  // the truth is 0; the parameters state 0.1 m
  const Match known = match_with_a_wall_across(0.01, guess);
  EXPECT_EQ(known.status, Status::converged);
  EXPECT_NEAR(known.reference_from_current.translation().x(), 0.0, 1e-6);
  EXPECT_NEAR(known.covariance(0, 0), 2e-4, 1e-5);          // of two scans
  const Match open = match_with_a_wall_across(0.1, guess);  // 0.14 m for two scans
  EXPECT_EQ(open.status, Status::degenerate);
  EXPECT_NEAR(open.reference_from_current.translation().x(), guess.translation().x(), 1e-6);
  EXPECT_NEAR(open.reference_from_current.translation().y(), 0.0, 1e-6);
  EXPECT_GT(open.covariance(0, 0), 100.0);
}

TEST(OptimalMatch, FindsTheHeadingInACorridorFromAGuessThatIsTurnedTooFarForItsWallsToPair) {
  // 3.8 standard deviations: a wall in a thousand differs by so much from its partner, a pose in a hundred.
  const Match found = match_with_itself(kCorridor, Pose2(0.05, 0.0, radians(11.5)));
  EXPECT_EQ(found.status, Status::degenerate);
  EXPECT_NEAR(found.reference_from_current.yaw(), 0.0, 1e-6);
  EXPECT_NEAR(found.reference_from_current.y(), 0.0, 1e-6);
}

TEST(OptimalMatch, FollowsManyWallsAgainstOneThatIsKnownBetter) {
  // Across the corridor, one scan sees the front of a recess and the other its back, 12 cm behind: two walls that look
  // like one, known to 0.3 mm. Nine short walls, known to 5 mm, tell them apart.
  std::vector<LineFeature> sides;
  for (double x = -4.0; x < 4.0; x += 0.8)
    for (const double y : {1.0, -1.0}) sides.push_back(wall({y * x, y}, {y * (x + 0.6), y}, 0.001));
  std::vector<LineFeature> reference = sides, current = sides;
  reference.push_back(wall({5, 1}, {5, -1}, 0.0003));
  current.push_back(wall({5.12, 1}, {5.12, -1}, 0.0003));
  for (const double x : {-3.5, -3.0, -2.0, -1.5, 1.0, 1.7, 2.2, 3.1, 3.9})
    for (std::vector<LineFeature>* const walls : {&reference, &current})
      walls->push_back(wall({x, 1.1}, {x, 0.9}, 0.005, 0.05));
  for (const double x : {-0.08, -0.05, 0.0, 0.05}) {
    const Match found = match_walls(reference, current, Pose2(x, 0.05, radians(2.0)));
    EXPECT_EQ(found.status, Status::converged) << x;
    EXPECT_NEAR(found.reference_from_current.x(), 0.0, 1e-3) << x;
    EXPECT_NEAR(std::sqrt(found.covariance(0, 0)), 0.005 * std::sqrt(2.0 / 9.0), 3e-4) << x;
  }
}

TEST(OptimalMatch, IsNoMatchWhereItIsLessProbableThanNoPairAtAll) {
  // Two short walls, known to 5 cm and 3 degrees, and a guess that they move by six standard deviations along both
  // axes: either fits by chance more often than a guess is so wrong. Long walls that are known well outweigh it.
  const Pose2 guess(0.45, 0.45, 0.0);
  const auto corner = [](double sigma_m, double sigma_rad) {
    return std::vector<LineFeature>{wall({4, 0}, {4, 2}, sigma_m, sigma_rad), wall({2, 4}, {0, 4}, sigma_m, sigma_rad)};
  };
  EXPECT_EQ(match_with_itself(corner(0.05, 0.05), guess).status, Status::no_match);
  const Match known = match_with_itself(corner(1e-5, 1e-5), guess);
  EXPECT_EQ(known.status, Status::converged);
  EXPECT_NEAR(known.reference_from_current.x(), 0.0, 1e-6);
}

}  // namespace
}  // namespace scanbench::matching
