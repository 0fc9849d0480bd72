// Parts of scan matchers: nearest returns by brute force, local lines of known walls, equations by numerical
// derivatives.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "algorithms/match/optimal/wall_pairs.hpp"
#include "algorithms/match/parts/extrapolation.hpp"
#include "algorithms/match/parts/nearest_return.hpp"
#include "algorithms/match/parts/pairs.hpp"
#include "algorithms/match/parts/pose_information.hpp"
#include "algorithms/match/parts/scan_points.hpp"
#include "tests/support/scan_builder.hpp"

namespace scanbench::matching {
namespace {

using support::cast;
using support::fan_sensor;
using support::OwnedScan;
using support::ring_sensor;
using support::with_noise;

void expect_nearest_by_brute_force(const OwnedScan& owned) {
  const Scan scan = owned.view();
  const ReturnedPoints points = returned_points(scan);
  NearestReturn nearest(points);
  CounterRng rng(7, RngStream::pose);
  std::size_t hint = points.size();
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec2 p(12.0 * rng.uniform() - 6.0, 12.0 * rng.uniform() - 6.0);
    const double gate = trial % 3 == 0 ? 0.2 : 20.0;
    std::vector<double> distances{gate, gate};
    for (const Vec2& q : points.points) distances.push_back((q - p).norm());
    std::ranges::sort(distances);
    const auto found = nearest.find(p, gate, trial % 2 == 0 ? hint : points.size());
    if (found) {
      EXPECT_DOUBLE_EQ((points.points[found->index] - p).norm(), distances[0]);
      EXPECT_DOUBLE_EQ(std::sqrt(found->square), distances[0]);
      EXPECT_DOUBLE_EQ(std::sqrt(found->others_square), distances[1]);
      hint = found->index;
    } else {
      EXPECT_EQ(distances[0], gate);
    }
  }
}

TEST(NearestReturn, IsThatOfBruteForce) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto room = support::random_room(seed);
    expect_nearest_by_brute_force(with_noise(cast(ring_sensor(360), room), 0.05, seed));
    expect_nearest_by_brute_force(with_noise(cast(fan_sensor(451, radians(270)), room), 0.05, seed));
    expect_nearest_by_brute_force(with_noise(cast(fan_sensor(181, kPi), room), 0.3, seed));
    OwnedScan clockwise = cast(fan_sensor(361, radians(270)), room);
    SensorModel sensor;
    sensor.geometry = ScanGeometry(radians(135), radians(-0.75), 361);
    expect_nearest_by_brute_force(with_noise(cast(sensor, room), 0.05, seed));
    OwnedScan holes = with_noise(cast(ring_sensor(360), room), 0.02, seed);
    for (std::size_t i = 0; i < holes.ranges.size(); ++i)
      if (i % 7 == 0 || (i > 100 && i < 200)) holes.ranges[i] = support::kInf;
    expect_nearest_by_brute_force(holes);
  }
}

TEST(NearestReturn, FollowsAPointThatMovesAsBruteForceDoes) {
  const OwnedScan owned = with_noise(cast(ring_sensor(360), support::random_room(4)), 0.05, 4);
  const Scan scan = owned.view();
  const ReturnedPoints points = returned_points(scan);
  NearestReturn nearest(points);
  CounterRng rng(8, RngStream::pose);
  const auto about = [&](double most) { return most * (2.0 * rng.uniform() - 1.0); };
  for (const double step_m : {1e-4, 3e-3, 0.05, 1.0}) {
    Track track;
    Vec2 p = points.points[50] + Vec2(0.1, 0.05);
    for (int trial = 0; trial < 500; ++trial) {
      double least = 0.5;
      for (const Vec2& q : points.points) least = std::min(least, (q - p).norm());
      const auto found = nearest.follow(p, 0.5, track);
      const double distance = found ? (points.points[*found] - p).norm() : 0.5;
      ASSERT_DOUBLE_EQ(distance, least) << step_m << " " << trial;
      p += Vec2(about(step_m), about(step_m));
    }
  }
}

TEST(Pairs, KeepTheNearestShareAsSortingDoes) {
  CounterRng rng(3, RngStream::pose);
  for (const std::size_t n : {1u, 2u, 7u, 63u, 64u, 65u, 451u, 2000u})
    for (const double share : {0.0, 0.3, 0.5, 0.9, 1.0})
      for (const int shape : {0, 1, 2, 3}) {  // normal, ascending, a few values many times, all equal
        std::vector<Pair> pairs(n);
        std::vector<double> sizes;
        for (std::size_t k = 0; k < n; ++k) {
          const double normal = rng.normal();
          pairs[k].residual = shape == 0   ? normal
                              : shape == 1 ? static_cast<double>(k)
                              : shape == 2 ? std::round(normal)
                                           : 0.25;
          sizes.push_back(std::fabs(pairs[k].residual));
        }
        std::ranges::sort(sizes);
        const double largest = sizes[static_cast<std::size_t>(share * static_cast<double>(n - 1))];
        keep_nearest(pairs, share);
        EXPECT_EQ(pairs.size(), static_cast<std::size_t>(std::ranges::upper_bound(sizes, largest) - sizes.begin()))
            << n << " pairs, share " << share << ", shape " << shape;
        for (const Pair& pair : pairs) EXPECT_LE(std::fabs(pair.residual), largest);
      }
}

TEST(Extrapolation, JumpsToTheLeastErrorOfAStraightWalk) {
  // Each step covers a tenth of what remains to 1; errors are squared distances from there, above a floor.
  Extrapolation extrapolation;
  const Eigen::Vector3d direction(0.6, 0.0, 0.8);
  double at = 0.0;
  std::vector<double> factors;
  for (int k = 0; k < 3; ++k) {
    const double step = 0.1 * (1.0 - at);
    factors.push_back(extrapolation.factor(step * direction, 0.3 + (1.0 - at) * (1.0 - at)));
    at += factors.back() * step;
  }
  EXPECT_EQ(factors[0], 1.0);
  EXPECT_EQ(factors[1], 1.0);
  EXPECT_NEAR(factors[2], 10.0, 1e-9);
  EXPECT_NEAR(at, 1.0, 1e-12);
}

TEST(Extrapolation, LeavesStepsAloneThatTurnOrWhoseErrorsGrowFaster) {
  Extrapolation turning, growing;
  for (int k = 0; k < 20; ++k) {
    EXPECT_EQ(turning.factor({std::cos(0.3 * k), std::sin(0.3 * k), 0.0}, std::pow(0.5, k)), 1.0);
    EXPECT_EQ(growing.factor({1.0, 0.0, 0.0}, 100.0 - k * k / 10.0), 1.0);
  }
  EXPECT_EQ(turning.factor(Eigen::Vector3d::Zero(), 0.0), 1.0);
}

TEST(LocalLines, OfAWallAreTheWall) {
  const OwnedScan scan = cast(fan_sensor(181, radians(120)), {{{2, -9}, {2, 9}}});
  const Scan view = scan.view();
  const ReturnedPoints points = returned_points(view);
  for (const LocalLine& line : local_lines(points)) {
    ASSERT_TRUE(line.known());
    EXPECT_NEAR(std::fabs(line.normal.x()), 1.0, 1e-9);
    EXPECT_NEAR(line.centre.x(), 2.0, 1e-9);
  }
}

TEST(LocalLines, HaveTheAngleVarianceOfTheirErrors) {
  // A wall seen obliquely too: along-beam noise must not turn its lines to one side.
  double sum = 0.0, mean = 0.0;
  int count = 0;
  for (std::uint32_t frame = 0; frame < 200; ++frame) {
    const OwnedScan scan = with_noise(cast(fan_sensor(181, radians(120)), {{{1, -9}, {1, 9}}}), 0.05, 3, frame);
    const Scan view = scan.view();
    const ReturnedPoints points = returned_points(view);
    const std::vector<LocalLine> lines = local_lines(points);
    const LocalLine& line = lines[points.size() / 4];
    if (!line.known()) continue;
    const double angle = wrap_direction(std::atan2(line.normal.y(), line.normal.x()));
    sum += angle * angle / line.angle_variance;
    mean += angle / std::sqrt(line.angle_variance);
    ++count;
  }
  ASSERT_GT(count, 150);
  EXPECT_NEAR(mean / count, 0.0, 0.3);
  EXPECT_GT(sum / count, 0.5);
  EXPECT_LT(sum / count, 1.6);
}

TEST(Motions, GoFromOnePoseToTheOther) {
  const Pose2 a(1, 2, 3.0), b(-2, 0.5, -3.0);
  const Pose2 back = moved(a, motion_between(a, b));
  EXPECT_NEAR((back.translation() - b.translation()).norm(), 0.0, 1e-12);
  EXPECT_NEAR(wrap_angle(back.yaw() - b.yaw()), 0.0, 1e-12);
  EXPECT_NEAR(motion_between(a, b).z(), kTwoPi - 6.0, 1e-12);
}

TEST(Determined, LeavesOpenWhatErrorsOfNormalsWouldMakeOfNothing) {
  // Two parallel walls whose normals are off by 0.01 rad, the standard deviation that they are said to have.
  PoseEquations equations;
  for (const double y : {-1.0, 1.0})
    for (const double x : {-2.0, 0.0, 2.0}) {
      const double turn = 0.01 * (x > 0 ? 1 : -1);
      equations.add({std::sin(turn), std::cos(turn)}, {x, y}, 0.02, 1e4, 1e-4);
    }
  const Determined determined(equations, 2.0, 3.0);
  EXPECT_EQ(determined.rank(), 2);
  EXPECT_NEAR(determined.solve(equations.rhs).x(), 0.0, 1e-3);
  EXPECT_NEAR(determined.solve(equations.rhs).y(), 0.02, 1e-3);
  const Eigen::Matrix3d covariance = determined.covariance(1.0);
  EXPECT_NEAR(std::sqrt(covariance(0, 0)), kOpenMotionM, 0.01 * kOpenMotionM);
  EXPECT_LT(std::sqrt(covariance(1, 1)), 1.1);  // the open motion leans by a hundredth at most
  EXPECT_NEAR((determined.project({5, 1, 0.1}) - Motion(0, 1, 0.1)).norm(), 0.0, 0.06);

  // Walls across are measured, not guessed: the same normals with a wall at the end determine all.
  equations.add({1, 0}, {4, 0}, 0.0, 1e4, 1e-4);
  EXPECT_EQ(Determined(equations, 2.0, 3.0).rank(), 3);
}

TEST(WallEquations, AreThoseOfNumericalDerivatives) {
  // The misfit of one pair is quadratic near its least: its derivatives are those of the equations.
  Eigen::Matrix2d c1, c2;
  c1 << 4e-6, 1e-6, 1e-6, 9e-6;
  c2 << 3e-6, -2e-6, -2e-6, 8e-6;
  const Vec2 normal(std::cos(0.4), std::sin(0.4));
  const std::vector<MeasuredLine> reference{{2.0 * normal + 0.3 * perpendicular(normal), normal, 1.0, c1}};
  const Pose2 pose(0.5, -0.3, 0.7);
  const std::vector<MeasuredLine> current{
      moved(pose.inverse(), {2.001 * normal - 0.2 * perpendicular(normal), normal, 0.8, c2})};
  const std::vector<WallPair> pairs{{{0}, {0}}};
  const auto misfit = [&](const Motion& motion) {
    return wall_equations(pairs, reference, current, moved(pose, motion)).misfit;
  };
  const WallEquations found = wall_equations(pairs, reference, current, pose);
  ASSERT_GT(found.walls, 0.99);
  const double h = 1e-6;
  for (int k = 0; k < 3; ++k) {
    const Motion e = h * Motion::Unit(k);
    const double slope = (misfit(e) - misfit(-e)) / (2 * h);
    EXPECT_NEAR(-0.5 * slope, found.equations.rhs(k), 2e-3 * found.equations.rhs.norm()) << k;
  }
}

/// A wall whose two lines are each in doubt: the plain lines are elsewhere, and better known.
struct DoubtedWall {
  std::vector<MeasuredLine> reference, current;
  Pose2 pose{0.5, -0.3, 0.7};
  std::vector<WallPair> pairs{{{0}, {0}}};

  /// `apart_m`: between the plain lines.
  explicit DoubtedWall(double apart_m) {
    Eigen::Matrix2d wide, plain;
    wide << 4e-4, 1e-5, 1e-5, 9e-5;
    plain << 4e-6, -1e-6, -1e-6, 2e-6;
    const Vec2 normal(std::cos(0.4), std::sin(0.4));
    const MeasuredLine line{2.0 * normal, normal, 1.0, wide, {0.004, 0.002}, plain};
    MeasuredLine other = line;
    other.plain_place.x() += apart_m;
    reference = {line};
    current = {moved(pose.inverse(), other)};
  }
  WallEquations equations(const Motion& motion = Motion::Zero()) const {
    return wall_equations(pairs, reference, current, moved(pose, motion));
  }
};

TEST(WallEquations, AreTheSlopeOfTheProbabilityOverAllWaysInWhichLinesAreOneWall) {
  // The evidence is the logarithm of a mixture, but for a constant. Its slope is the sum of the slopes of the parts,
  // weighted with their probabilities (Dempster, Laird & Rubin 1977).
  for (const double apart_m : {0.0, 0.003, 0.008, 0.02}) {
    const DoubtedWall wall(apart_m);
    const WallEquations found = wall.equations();
    const double h = 1e-6;
    for (int k = 0; k < 3; ++k) {
      const Motion e = h * Motion::Unit(k);
      const double slope = (wall.equations(e).evidence - wall.equations(-e).evidence) / (2 * h);
      // What remains is the change of the normals by the motion, which the equations leave out.
      EXPECT_NEAR(slope, found.equations.rhs(k), 0.02 * found.equations.rhs.norm() + 0.5) << apart_m << ' ' << k;
    }
  }
}

TEST(WallEquations, DoubtThatMovesBothLinesAlikeIsNotBetweenThem) {
  // Plain lines that agree to a fraction of their noise know the wall's offset to sqrt(2) 2 mm; if they are ten of
  // their standard deviations apart, doubt moved one of them, and the offset is known to sqrt(2) 20 mm.
  const auto sigma_m = [](double apart_m) {
    const WallEquations found = DoubtedWall(apart_m).equations();
    const Motion along(std::cos(0.4), std::sin(0.4), 0.0);
    return 1.0 / std::sqrt(along.dot(found.equations.matrix * along));
  };
  const double plain = std::sqrt(2.0) * 0.002, wide = std::sqrt(2.0) * 0.02;
  EXPECT_NEAR(sigma_m(0.0), plain, 0.1 * plain);
  EXPECT_NEAR(sigma_m(10.0 * plain), wide, 0.1 * wide);
}

TEST(WallEquations, AWallKnownToAMillimetreCountsWhileThePoseIsKnownToADecimetre) {
  const Eigen::Matrix2d c = 1e-6 * Eigen::Matrix2d::Identity();
  const Vec2 ahead(1, 0);
  const std::vector<MeasuredLine> wall{{{12, 0}, ahead, 1.0, c}};
  const std::vector<WallPair> pairs{{{0}, {0}}};
  const Pose2 guess(0.05, 0.0, 0.0);  // the true pose is 0
  const auto weight = [&](double sigma_m) {
    const Eigen::Matrix3d doubt = sigma_m * sigma_m * Eigen::Matrix3d::Identity();
    return wall_equations(pairs, wall, wall, guess, {doubt}).walls;
  };
  EXPECT_GT(weight(0.1), 0.9);     // half a standard deviation off
  EXPECT_LT(weight(0.005), 1e-6);  // ten standard deviations off: not one wall
  // Doubt changes the weight of a wall, not what the wall says.
  const PoseDoubt decimetre{0.01 * Eigen::Matrix3d::Identity()};
  const WallEquations found = wall_equations(pairs, wall, wall, guess, decimetre);
  EXPECT_NEAR(found.equations.rhs.x() / found.equations.matrix(0, 0), -0.05, 1e-9);
}

TEST(WallEquations, WallsCountAlikeIfTheDoubtIsOfEachWall) {
  // Ten walls ahead. One is known to 0.3 mm and says 12 cm, nine are known to 5 mm and say 0.
  const auto ahead = [](double x_m, double sigma_m) {
    return MeasuredLine{{x_m, 0}, {1, 0}, 1.0, Eigen::Vector2d(sigma_m * sigma_m, 1e-4).asDiagonal().toDenseMatrix()};
  };
  std::vector<MeasuredLine> reference{ahead(5.12, 0.0003)}, current{ahead(5.0, 0.0003)};
  std::vector<WallPair> pairs{{{0}, {0}}};
  for (std::size_t k = 1; k < 10; ++k) {
    reference.push_back(ahead(5.0 + static_cast<double>(k), 0.005));
    current.push_back(reference.back());
    pairs.push_back({{k}, {k}});
  }
  const auto step = [&](bool of_each_wall) {
    const PoseDoubt decimetre{0.01 * Eigen::Matrix3d::Identity(), of_each_wall};
    const WallEquations found = wall_equations(pairs, reference, current, {}, decimetre);
    return found.equations.rhs.x() / found.equations.matrix(0, 0);
  };
  EXPECT_NEAR(step(false), 0.12, 0.005);
  EXPECT_NEAR(step(true), 0.012, 0.001);
}

TEST(PairWalls, JoinsWhatAnObstacleCutsInTwo) {
  const Eigen::Matrix2d c = 1e-6 * Eigen::Matrix2d::Identity();
  const Vec2 up(0, 1);
  const std::vector<MeasuredLine> pieces{{{-2, 3}, up, 1.0, c}, {{2, 3}, up, 1.0, c}, {{2, 3.3}, up, 1.0, c}};
  const std::vector<MeasuredLine> whole{{{0, 3}, up, 3.0, c}};
  const PoseBelief belief{{}, 1e-6 * Eigen::Matrix3d::Identity()};
  const auto one = pair_walls(pieces, whole, belief);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].reference, (std::vector<std::size_t>{0, 1}));
  const auto other = pair_walls(whole, pieces, belief);
  ASSERT_EQ(other.size(), 1u);
  EXPECT_EQ(other[0].current, (std::vector<std::size_t>{0, 1}));
}

/// Walls along x known to 1 mm, headings to 0.5 mrad, and the motion along x to `along_m`, by noise of both scans.
PairInformation corridor_information(double along_m) {
  PairInformation information;
  information.equations.matrix =
      2.0 * Eigen::Vector3d(1.0 / (along_m * along_m), 1e6, 4e6).asDiagonal().toDenseMatrix();
  information.misfit = 500.0;
  information.count = 503;
  return information;
}

const Guess kNearGuess({1.0, 2.0, 0.1}, 0.1, 0.05);

Match concluded(double along_m, double off_m, bool held = true) {
  return conclusion(corridor_information(along_m), {1.0 + off_m, 2.02, 0.12}, kNearGuess, held, 3.0, true);
}

TEST(Conclusion, AWeakMotionAgainstTheGuessIsOpen) {
  for (const double along_m : {0.03, 0.08}) {
    const Match match = concluded(along_m, 0.3);
    EXPECT_EQ(match.status, Status::degenerate);
    EXPECT_NEAR(match.reference_from_current.x(), 1.0, 1e-9) << "as guessed";
    EXPECT_NEAR(match.reference_from_current.y(), 2.02, 1e-9) << "the walls know it";
    EXPECT_NEAR(match.reference_from_current.yaw(), 0.12, 1e-9);
    EXPECT_NEAR(match.covariance(0, 0), kOpenMotionM * kOpenMotionM, 1e-6);
    EXPECT_NEAR(match.covariance(1, 1), 1e-6, 1e-12);
  }
}

TEST(Conclusion, WithinTheGuessOrWithoutItTheWallsDecide) {
  for (const Match& match : {concluded(0.03, 0.2), concluded(0.03, 0.3, false)}) {
    EXPECT_EQ(match.status, Status::converged);
    EXPECT_NEAR(match.covariance(0, 0), 0.03 * 0.03, 1e-9);
  }
  EXPECT_EQ(concluded(0.03, 0.2).reference_from_current.x(), 1.2);
}

TEST(Conclusion, WhatWallsKnowFarBetterStaysAndIsStatedWithDoubt) {
  const Match match = concluded(0.01, 0.4);
  EXPECT_EQ(match.status, Status::converged);
  EXPECT_EQ(match.reference_from_current.x(), 1.4);
  const double off = std::hypot(0.4, 0.02), rest = off - 0.1 * std::sqrt(5.99);
  EXPECT_NEAR(match.covariance(0, 0), 0.01 * 0.01 + rest * rest * (0.4 / off) * (0.4 / off), 1e-9);
}

}  // namespace
}  // namespace scanbench::matching
