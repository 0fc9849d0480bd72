// Multi-scan point-to-line ICP: what must hold by mathematics.
#include <gtest/gtest.h>

#include <cmath>

#include "algorithms/align/parts/pose_equations.hpp"
#include "core/rng.hpp"
#include "core/special_values.hpp"
#include "tests/support/aligning.hpp"
#include "tests/support/matchers.hpp"
#include "tests/support/trace_recorder.hpp"

namespace scanbench {
namespace {

using support::AngleNear;
using support::box;
using support::cast;
using support::OwnedScan;
using support::PointNear;
using support::polygon;
using support::ring_sensor;
using support::ScanSeries;
using support::with_noise;

Alignment align(const ScanSeries& scans, const std::vector<Pose2>& initial, const ParamSet& params = {}) {
  return support::align("point_to_line", scans, initial, params);
}

void expect_poses(const std::vector<Pose2>& poses, const std::vector<Pose2>& expected, double tolerance) {
  ASSERT_EQ(poses.size(), expected.size());
  for (std::size_t k = 0; k < poses.size(); ++k) {
    EXPECT_THAT(poses[k].translation(), PointNear(expected[k].translation(), tolerance)) << "scan " << k;
    EXPECT_THAT(poses[k].yaw(), AngleNear(expected[k].yaw(), tolerance)) << "scan " << k;
  }
}

std::vector<Pose2> moved(const Pose2& by, const std::vector<Pose2>& poses) {
  std::vector<Pose2> result;
  for (const Pose2& p : poses) result.push_back(by * p);
  return result;
}

/// No two walls are parallel.
std::vector<Segment> point_line_room() {
  return polygon({{-3, -2}, {4, -2.5}, {4.6, 1.2}, {2.2, 2.9}, {-2.6, 2.2}});
}

std::vector<Pose2> point_line_path() {
  return {{0, 0, 0},        {0.7, -0.3, 0.4},  {1.6, 0.2, 1.2},   {2.1, 0.9, 2.5},
          {0.8, 1.1, -2.9}, {-0.9, 0.8, -2.0}, {-1.4, -0.5, -0.7}};
}

/// Each pose off by up to 12 cm in x and y and 4 degrees, none twice.
std::vector<Pose2> point_line_start(std::vector<Pose2> poses, std::uint64_t seed) {
  CounterRng rng(seed, RngStream::pose);
  const auto within = [&](double most) { return most * (2 * rng.uniform() - 1); };
  for (Pose2& p : poses) p = p * Pose2(within(0.12), within(0.12), within(radians(4)));
  return poses;
}

ScanSeries exact_scans(const std::vector<Segment>& walls, const std::vector<Pose2>& poses) {
  ScanSeries scans;
  for (const Pose2& p : poses) scans.add_exact(cast(ring_sensor(360), walls, p));
  return scans;
}

ScanSeries noisy_scans(const std::vector<Segment>& walls, const std::vector<Pose2>& poses, double sigma_m) {
  ScanSeries scans;
  for (std::size_t k = 0; k < poses.size(); ++k)
    scans.add_extracted(with_noise(cast(ring_sensor(360), walls, poses[k]), sigma_m, 5, static_cast<std::uint32_t>(k)));
  return scans;
}

/// The true poses, seen from where the first scan is held.
std::vector<Pose2> held_at_first(const std::vector<Pose2>& truth, const std::vector<Pose2>& initial) {
  return moved(initial.front() * truth.front().inverse(), truth);
}

TEST(PointToLine, RecoversThePosesOfScansWithoutNoise) {
  const ScanSeries scans = exact_scans(point_line_room(), point_line_path());
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<Pose2> initial = point_line_start(point_line_path(), seed);
    const Alignment result = align(scans, initial);
    EXPECT_EQ(result.status, Status::converged);
    expect_poses(result.world_from_sensor, held_at_first(point_line_path(), initial), 1e-9);
  }
}

TEST(PointToLine, LeavesExactPosesWhereTheyAre) {
  const Alignment result = align(exact_scans(point_line_room(), point_line_path()), point_line_path());
  EXPECT_EQ(result.status, Status::converged);
  expect_poses(result.world_from_sensor, point_line_path(), 1e-12);
}

TEST(PointToLine, DoesNotTakeTheTwoFacesOfAThinWallForOne) {
  auto walls = point_line_room();
  for (const Segment& s : polygon({{-0.5, 0.02}, {-0.5, -0.02}, {2.5, -0.02}, {2.5, 0.02}}))
    walls.push_back({s.b, s.a});
  const std::vector<Pose2> poses{{0.5, 1.0, 0}, {1.2, 1.1, 0.5}, {0.5, -1.0, 0.2}, {1.2, -1.2, 1.0}, {-1.5, 0, 0.1}};
  const ScanSeries scans = exact_scans(walls, poses);
  expect_poses(align(scans, poses).world_from_sensor, poses, 1e-12);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const std::vector<Pose2> initial = point_line_start(poses, seed);
    expect_poses(align(scans, initial).world_from_sensor, held_at_first(poses, initial), 1e-9);
  }
}

TEST(PointToLine, KeepsThePredictionAlongACorridorAndSaysSo) {
  const Pose2 world_from_corridor(3, -2, radians(30));
  const Vec2 axis = world_from_corridor.rotate({1, 0});
  std::vector<Segment> walls;
  for (const Segment& s : {Segment{{-100, -1}, {100, -1}}, Segment{{100, 1.5}, {-100, 1.5}}})
    walls.push_back(world_from_corridor * s);
  std::vector<Pose2> truth;
  for (int k = 0; k < 6; ++k) truth.push_back(world_from_corridor * Pose2(0.8 * k, 0.1 * k, 0.1 * k));
  ScanSeries scans;
  for (const Pose2& p : truth) {
    OwnedScan scan = cast(ring_sensor(360), walls, p);
    for (std::size_t i = 0; i < scan.ranges.size(); ++i)
      if (scan.ranges[i] > 12) scan.ranges[i] = kInf, scan.ids[i] = -1;
    scans.add_exact(std::move(scan));
  }
  const std::vector<Pose2> initial = point_line_start(truth, 3);
  const Alignment result = align(scans, initial);
  EXPECT_EQ(result.status, Status::degenerate);
  const std::vector<Pose2>& poses = result.world_from_sensor;
  const std::vector<Pose2> expected = held_at_first(truth, initial);
  const Vec2 held_axis = expected[0].rotate(truth[0].inverse().rotate(axis));
  for (std::size_t k = 1; k < poses.size(); ++k) {
    const Pose2 predicted = poses[k - 1] * (initial[k - 1].inverse() * initial[k]);
    const Vec2 correction = poses[k].translation() - predicted.translation();
    EXPECT_NEAR(correction.dot(held_axis), 0.0, 1e-9);
    EXPECT_GT(std::abs(cross(correction, held_axis)), 1e-3) << "there was something to correct across";
    EXPECT_NEAR(cross(poses[k].translation() - expected[k].translation(), held_axis), 0.0, 1e-9);
    EXPECT_THAT(poses[k].yaw(), AngleNear(expected[k].yaw(), 1e-9));
  }
}

TEST(PointToLine, MovesWithTheWorldFrame) {
  const ScanSeries scans = noisy_scans(point_line_room(), point_line_path(), 0.01);
  const std::vector<Pose2> initial = point_line_start(point_line_path(), 4);
  const Alignment here = align(scans, initial);
  for (const Pose2& elsewhere : {Pose2(0, 0, 2.0), Pose2(40, -25, -1.1), Pose2(-300, 700, 0.3)}) {
    const Alignment there = align(scans, moved(elsewhere, initial));
    EXPECT_EQ(there.status, here.status);
    expect_poses(there.world_from_sensor, moved(elsewhere, here.world_from_sensor), 1e-9);
  }
}

TEST(PointToLine, AlignsNoisyScansBetterThanOneReadingMeasures) {
  const ScanSeries scans = noisy_scans(point_line_room(), point_line_path(), 0.02);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const std::vector<Pose2> initial = point_line_start(point_line_path(), seed);
    const Alignment result = align(scans, initial);
    EXPECT_EQ(result.status, Status::converged);
    // Some 70 readings per wall: the mean of sigma = 2 cm has an error of 2.4 mm, and three times that is rare.
    expect_poses(result.world_from_sensor, held_at_first(point_line_path(), initial), 0.008);
  }
}

/// Sum of Tukey's loss over fixed pairs of points and lines, by a plain loop. Pairs are those of `at`.
class Loss {
 public:
  Loss(const ScanSeries& scans, const std::vector<Pose2>& at, double gate_m, double margin_m) : gate_(gate_m) {
    const std::vector<Observation> seen = scans.observations();
    for (std::size_t i = 0; i < seen.size(); ++i)
      for (const Vec2& p : valid_points(seen[i].scan).points)
        for (std::size_t j = 0; j < seen.size(); ++j) {
          if (i == j) continue;
          double nearest = gate_m;
          const Segment* line = nullptr;
          for (const LineFeature& f : seen[j].lines.lines) {
            const Segment s = at[j] * f.segment;
            const Vec2 q = at[i] * p;
            const double u = s.direction().dot(q - s.a), d = cross(s.direction(), q - s.a);
            const double sensor = cross(s.direction(), at[i].translation() - s.a);
            if (u < -margin_m || u > s.length() + margin_m || sensor <= 0 || sensor <= d || std::abs(d) >= nearest)
              continue;
            nearest = std::abs(d);
            line = &f.segment;
          }
          if (line != nullptr) pairs_.push_back({i, j, p, *line});
        }
  }
  double at(const std::vector<Pose2>& poses) const {
    double sum = 0.0;
    for (const auto& [i, j, p, s] : pairs_) {
      const Vec2 q = poses[j].inverse() * (poses[i] * p);
      const double u = cross(s.direction(), q - s.a) / gate_;
      sum += u * u < 1 ? 1 - std::pow(1 - u * u, 3) : 1;
    }
    return gate_ * gate_ / 6 * sum;
  }
  std::size_t pairs() const { return pairs_.size(); }

 private:
  struct Pair {
    std::size_t i, j;
    Vec2 point;
    Segment line;
  };
  double gate_;
  std::vector<Pair> pairs_;
};

TEST(PointToLine, EndsAtAMinimumOfTheLossOverAllPairs) {
  const ScanSeries scans = noisy_scans(point_line_room(), point_line_path(), 0.02);
  const std::vector<Pose2> poses = align(scans, point_line_start(point_line_path(), 6)).world_from_sensor;
  const Loss loss(scans, poses, 0.1, 0.2);
  ASSERT_GT(loss.pairs(), 10000u);
  const double least = loss.at(poses);
  const double s = 1e-3;  // steps end at 1e-4
  for (std::size_t k = 1; k < poses.size(); ++k)
    for (const Pose2& by :
         {Pose2(s, 0, 0), Pose2(-s, 0, 0), Pose2(0, s, 0), Pose2(0, -s, 0), Pose2(0, 0, s / 2), Pose2(0, 0, -s / 2)}) {
      std::vector<Pose2> other = poses;
      other[k] = other[k] * by;
      EXPECT_GT(loss.at(other), least) << "scan " << k;
    }
}

TEST(PointToLine, ComesToTheSamePosesWhicheverScanIsFirst) {
  const ScanSeries forward = noisy_scans(point_line_room(), point_line_path(), 0.01);
  const std::vector<Pose2> initial = point_line_start(point_line_path(), 8);
  const std::vector<Pose2> result = align(forward, initial).world_from_sensor;

  ScanSeries backward;
  for (std::size_t k = point_line_path().size(); k-- > 0;)
    backward.add_extracted(with_noise(cast(ring_sensor(360), point_line_room(), point_line_path()[k]), 0.01, 5,
                                      static_cast<std::uint32_t>(k)));
  std::vector<Pose2> reversed = align(backward, {initial.rbegin(), initial.rend()}).world_from_sensor;
  std::reverse(reversed.begin(), reversed.end());
  expect_poses(moved(result[0] * reversed[0].inverse(), reversed), result, 5e-4);  // steps end at 1e-4 m
}

TEST(PointToLine, NoScanAndOneAreConvergedWhereTheyAre) {
  EXPECT_EQ(align({}, {}).status, Status::converged);
  const std::vector<Pose2> one{{1, 2, 3}};
  const Alignment result = align(exact_scans(point_line_room(), {{0, 0, 0}}), one);
  EXPECT_EQ(result.status, Status::converged);
  EXPECT_EQ(result.world_from_sensor, one);
}

TEST(PointToLine, LeavesScansWithoutReturnsOrLinesWhereTheyWere) {
  const std::vector<Pose2> initial = point_line_start(point_line_path(), 9);
  for (const double nothing : {kInf, -kInf, kNaN, 0.0}) {
    ScanSeries scans;
    for (std::size_t k = 0; k < initial.size(); ++k) scans.add_exact(support::constant_scan(ring_sensor(90), nothing));
    const Alignment result = align(scans, initial);
    EXPECT_EQ(result.status, Status::no_match);
    EXPECT_EQ(result.world_from_sensor, initial);
  }
  ScanSeries without_lines;
  for (const Pose2& p : point_line_path()) {
    const OwnedScan scan = cast(ring_sensor(90), point_line_room(), p);
    without_lines.add(scan, {.lines = {}, .labels = std::vector<int>(90, -1)});
  }
  const Alignment result = align(without_lines, initial);
  EXPECT_EQ(result.status, Status::no_match);
  EXPECT_EQ(result.world_from_sensor, initial);
}

TEST(PointToLine, AScanWithoutReturnsKeepsItsStepFromTheOneBefore) {
  ScanSeries scans;
  for (std::size_t k = 0; k < point_line_path().size(); ++k)
    scans.add_exact(k == 3 ? support::constant_scan(ring_sensor(90), kNaN)
                           : cast(ring_sensor(360), point_line_room(), point_line_path()[k]));
  const std::vector<Pose2> initial = point_line_start(point_line_path(), 10);
  const Alignment result = align(scans, initial);
  EXPECT_EQ(result.status, Status::degenerate);
  std::vector<Pose2> expected = held_at_first(point_line_path(), initial);
  expected[3] = expected[2] * (initial[2].inverse() * initial[3]);
  expect_poses(result.world_from_sensor, expected, 1e-9);
}

TEST(PointToLine, AScanWithoutLinesOfItsOwnIsRegisteredByItsPoints) {
  ScanSeries scans;
  for (std::size_t k = 0; k < point_line_path().size(); ++k) {
    // The beams are so dense that the last point of a wall is within the margin of the corner: without its own surface,
    // a point between the two would be assigned to the next wall.
    const OwnedScan scan = cast(ring_sensor(1440), point_line_room(), point_line_path()[k]);
    if (k == 3) {
      scans.add(scan, {.lines = {}, .labels = std::vector<int>(1440, -1)});
    } else {
      scans.add_exact(scan);
    }
  }
  const std::vector<Pose2> initial = point_line_start(point_line_path(), 11);
  const Alignment result = align(scans, initial);
  EXPECT_EQ(result.status, Status::converged);
  expect_poses(result.world_from_sensor, held_at_first(point_line_path(), initial), 1e-9);
}

TEST(PointToLine, EqualScansAtOnePoseStay) {
  const std::vector<Pose2> poses(5, Pose2(0.3, -0.2, 0.5));
  const Alignment result = align(exact_scans(point_line_room(), poses), poses);
  EXPECT_EQ(result.status, Status::converged);
  expect_poses(result.world_from_sensor, poses, 1e-12);
}

TEST(PointToLine, FaultyReadingsAreAsIfThereWasNothingInRange) {
  const std::vector<Pose2> initial = point_line_start(point_line_path(), 12);
  std::vector<Alignment> results;
  for (const double reading : {kInf, kNaN, -kInf, 0.0, -1.0}) {
    ScanSeries scans;
    for (const Pose2& p : point_line_path()) {
      OwnedScan scan = cast(ring_sensor(360), point_line_room(), p);
      for (std::size_t i = 0; i < 360; i += 7) scan.ranges[i] = reading;
      scans.add_extracted(std::move(scan), "iepf");
    }
    results.push_back(align(scans, initial));
    EXPECT_EQ(results.back().world_from_sensor, results.front().world_from_sensor);
  }
}

TEST(PointToLine, SaysWhenItWasStopped) {
  const Alignment result = align(noisy_scans(point_line_room(), point_line_path(), 0.02),
                                 point_line_start(point_line_path(), 13), {{"max_rounds", std::int64_t{1}}});
  EXPECT_EQ(result.status, Status::max_iterations);
}

TEST(PointToLine, RefusesAFinalGateWiderThanTheFirst) {
  EXPECT_THROW(Registry<Aligner>::make("point_to_line", {{"gate_m", 0.2}, {"final_gate_m", 0.3}}), ParamError);
}

TEST(PointToLine, WritesARowForEachRound) {
  support::TraceRecorder recorder("align");
  Registry<Aligner>::make("point_to_line")
      ->align(noisy_scans(point_line_room(), point_line_path(), 0.02).observations(),
              point_line_start(point_line_path(), 14), recorder.trace);
  const auto& rows = recorder.all_rows.at("align.round");
  ASSERT_GE(rows.size(), 4u);
  constexpr double kFinalGate = 0.1;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    ASSERT_EQ(rows[k].values.size(), 6u);
    EXPECT_EQ(rows[k].values[0], static_cast<double>(k));
    EXPECT_EQ(rows[k].values[1], std::max(rows[0].values[1] / std::exp2(static_cast<double>(k)), kFinalGate));
  }
  EXPECT_GT(rows[0].values[1], kFinalGate);
  EXPECT_EQ(rows.back().values[1], kFinalGate);
  EXPECT_NEAR(rows.back().values[3], 0.02, 0.01) << "residual: the noise of a reading";
  EXPECT_LT(rows.back().values[4], 1e-4);
  EXPECT_LT(rows.back().values[5], 1e-5);
}

TEST(TukeyWeight, TimesTheResidualIsTheSlopeOfTheLoss) {
  const double gate = 0.1, h = 1e-6;
  const auto loss = [&](double r) {
    const double u = r / gate;
    return gate * gate / 6 * (std::abs(u) < 1 ? 1 - std::pow(1 - u * u, 3) : 1);
  };
  for (const double r : {-0.2, -0.1, -0.07, -0.01, 0.0, 0.03, 0.06, 0.099, 0.15})
    EXPECT_NEAR(align::tukey_weight(r, gate) * r, (loss(r + h) - loss(r - h)) / (2 * h), 1e-8) << r;
}

TEST(ObservableMotions, AreThoseThatTheMatrixDetermines) {
  using align::observable;
  EXPECT_EQ(observable(Eigen::Matrix3d::Zero()).rank(), 0);
  EXPECT_EQ(observable(Eigen::Matrix3d::Identity()).rank(), 3);
  // Walls along x do not determine x.
  const align::Observable corridor = observable(Eigen::Vector3d(1e-4, 1.0, 0.5).asDiagonal());
  ASSERT_EQ(corridor.rank(), 2);
  EXPECT_NEAR(corridor.motions.row(0).norm(), 0.0, 1e-15);
  EXPECT_EQ(observable(Eigen::Vector3d(2e-3, 1.0, 0.5).asDiagonal()).rank(), 3);
}

TEST(PointToLine, NamesGroupsOfScansThatDoNotMeet) {
  ScanSeries scans;
  std::vector<Pose2> poses;
  for (const Pose2& shift : {Pose2(0, 0, 0), Pose2(60, 0, 0)})
    for (const Pose2& p : point_line_path()) {
      scans.add_exact(cast(ring_sensor(360), point_line_room(), p));
      poses.push_back(shift * p);
    }
  const Alignment result = align(scans, poses);
  EXPECT_EQ(result.status, Status::degenerate);
  EXPECT_NE(result.message.find("2 groups of scans do not meet: 7 scans; 7 scans"), std::string::npos)
      << result.message;
}

TEST(PointToLine, NamesGroupsOfManyScansThatDoNotMeet) {
  ScanSeries scans;
  std::vector<Pose2> poses;
  for (int k = 0; k < 210; ++k) {
    const Pose2 in_room(0.01 * (k % 105), 0.3, 0.02 * k);
    scans.add_exact(cast(ring_sensor(36), point_line_room(), in_room));
    poses.push_back(Pose2(k < 105 ? 0 : 60, 0, 0) * in_room);
  }
  const Alignment result = align(scans, poses);
  EXPECT_EQ(result.status, Status::degenerate);
  EXPECT_NE(result.message.find("2 groups of scans do not meet: 105 scans; 105 scans"), std::string::npos)
      << result.message;
  expect_poses(result.world_from_sensor, poses, 0.01);  // each group keeps its place
}

TEST(PointToLine, TheFirstGateIsTwoAndAHalfDeviationsOfTheStatedError) {
  // Two poses are wrong independently of each other; no error of the heading, so that no distance matters.
  for (const double sigma : {0.05, 0.1, 0.4}) {
    support::TraceRecorder recorder("align");
    Registry<Aligner>::make("point_to_line", {{"odometry_sigma_m", sigma}, {"odometry_sigma_deg", 0.0}})
        ->align(exact_scans(point_line_room(), point_line_path()).observations(), point_line_path(), recorder.trace);
    EXPECT_NEAR(recorder.all_rows.at("align.round").front().values[1], 2.5 * std::sqrt(2.0) * sigma, 1e-12);
  }
}

TEST(PointToLine, LooksAsFarAsTheStatedErrorOfTheGivenPosesAsks) {
  const ScanSeries scans = exact_scans(point_line_room(), point_line_path());
  std::vector<Pose2> initial = point_line_path();
  initial[3] = initial[3] * Pose2(0.7, -0.6, radians(5));
  expect_poses(align(scans, initial, {{"odometry_sigma_m", 0.5}, {"odometry_sigma_deg", 6.0}}).world_from_sensor,
               held_at_first(point_line_path(), initial), 1e-6);
  const Alignment near = align(scans, initial, {{"odometry_sigma_m", 0.01}, {"odometry_sigma_deg", 0.1}});
  EXPECT_GT((near.world_from_sensor[3].translation() - point_line_path()[3].translation()).norm(), 0.1);
}

}  // namespace
}  // namespace scanbench
