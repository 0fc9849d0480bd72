// Bounds of poses against numerical derivatives and special cases whose bound is known; pose_efficiency by hand.
#include "metrics/pose_bound.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "tests/metrics/made_up.hpp"

namespace scanbench::test {
namespace {

using metrics::join_walls;
using metrics::pose_information;
using metrics::PoseInformation;

constexpr double kBoundSigma = 0.02;

std::vector<Wall> room() {
  const std::vector<Vec2> corners{{-3, -2}, {4, -2}, {4, 2.5}, {-3, 2.5}};
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < 4; ++i) walls.push_back({std::to_string(i), {corners[i], corners[(i + 1) % 4]}});
  return walls;
}

MadeUpRun pose_seen_from(const std::vector<Wall>& walls, const std::vector<Pose2>& poses, int beams = 180) {
  MadeUpRun run = make_run(ScanGeometry(-kPi, kTwoPi / beams, beams), walls);
  run.observed.sensor.noise.sigma_m = kBoundSigma;
  for (const Pose2& pose : poses) cast_frame(run, pose);
  return run;
}

PoseInformation information_of(const MadeUpRun& run) {
  return pose_information(run.input(), join_walls(run.truth.walls), 0, 1);
}

TEST(PoseBound, OfAKnownMapIsTheInformationFromNumericalDerivatives) {
  const Pose2 first(0.3, -0.2, 0.4), step(0.2, 0.1, -0.3);
  const Eigen::Matrix3d found = information_of(pose_seen_from(room(), {first, first * step})).known_map;

  const double h = 1e-6;
  const auto ranges = [&](const Eigen::Vector3d& motion) {
    const Pose2 moved(step.x() + motion.x(), step.y() + motion.y(), step.yaw() + motion.z());
    return pose_seen_from(room(), {first * moved}).truth.ranges;
  };
  std::vector<std::vector<double>> derivatives;
  for (int k = 0; k < 3; ++k) {
    const auto ahead = ranges(h * Eigen::Vector3d::Unit(k)), behind = ranges(-h * Eigen::Vector3d::Unit(k));
    derivatives.emplace_back();
    for (std::size_t i = 0; i < ahead.size(); ++i) derivatives.back().push_back((ahead[i] - behind[i]) / (2 * h));
  }
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < derivatives[0].size(); ++i) {
    const Eigen::Vector3d g(derivatives[0][i], derivatives[1][i], derivatives[2][i]);
    expected += g * g.transpose() / (kBoundSigma * kBoundSigma);
  }
  EXPECT_LT((found - expected).norm(), 1e-5 * expected.norm());
}

TEST(PoseBound, OfTwoEqualScansIsHalfTheInformationOfAKnownMap) {
  const PoseInformation found = information_of(pose_seen_from(room(), {{0.3, -0.2, 0.4}, {0.3, -0.2, 0.4}}));
  EXPECT_LT((found.unknown_walls - 0.5 * found.known_map).norm(), 1e-9 * found.known_map.norm());
  EXPECT_EQ(found.surfaces, 4);
}

TEST(PoseBound, OfUnknownWallsNeverExceedsThatOfAKnownMap) {
  for (double turn = 0.0; turn < 3.0; turn += 0.7) {
    const PoseInformation found = information_of(pose_seen_from(room(), {{0, 0, turn}, {0.5, 0.3, 2 * turn}}));
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(found.known_map - found.unknown_walls);
    EXPECT_GE(eigen.eigenvalues()(0), -1e-9 * found.known_map.norm());
  }
}

TEST(PoseBound, OfUnknownWallsDoesNotDependOnTheWorldFrame) {
  const Pose2 first(0.3, -0.2, 0.4), step(0.2, 0.1, -0.3), elsewhere(5, -9, 2.0);
  std::vector<Wall> moved = room();
  for (Wall& wall : moved) wall.segment = elsewhere * wall.segment;
  const Eigen::Matrix3d here = information_of(pose_seen_from(room(), {first, first * step})).unknown_walls;
  const Eigen::Matrix3d there =
      information_of(pose_seen_from(moved, {elsewhere * first, elsewhere * first * step})).unknown_walls;
  EXPECT_LT((here - there).norm(), 1e-6 * here.norm());
}

TEST(PoseBound, LeavesTheAxisOfACorridorOpen) {
  const std::vector<Wall> corridor{{"a", {{-50, -1}, {50, -1}}}, {"b", {{50, 1}, {-50, 1}}}};
  const PoseInformation found = information_of(pose_seen_from(corridor, {{0, 0, 0.5}, {0.2, 0.1, 0.6}}));
  EXPECT_TRUE(std::isinf(metrics::weakest_sigma_m(found.unknown_walls, 3.0)));
  const Vec2 axis = Pose2(0, 0, 0.5).inverse().rotate({1, 0});
  const Eigen::Vector3d along(axis.x(), axis.y(), 0.0);
  EXPECT_LT(along.dot(found.unknown_walls * along), 1e-9 * found.unknown_walls.norm());
}

TEST(PoseEfficiency, ComparesErrorsWithTheBoundAndWithTheCovariance) {
  const Pose2 first(0.3, -0.2, 0.4), step(0.2, 0.1, -0.3);
  MadeUpRun run = pose_seen_from(room(), {first, first * step});
  const Eigen::Matrix3d bound = information_of(run).unknown_walls.inverse();
  FrameMatch match{.frame = 1, .reference = 0, .match = {}};
  match.match.reference_from_current = {step.x() + 0.003, step.y() - 0.004, step.yaw() + 0.002};
  match.match.covariance = Eigen::Vector3d(0.003 * 0.003, 0.002 * 0.002, 0.002 * 0.002).asDiagonal();
  run.result.matches = {match};
  const auto rows = evaluate("pose_efficiency", run);
  EXPECT_NEAR(row(rows, "pose_error_position").value, 0.005, 1e-9);
  EXPECT_NEAR(row(rows, "pose_error_heading").value, degrees(0.002), 1e-9);
  EXPECT_NEAR(row(rows, "pose_efficiency_position").value, 25e-6 / (bound(0, 0) + bound(1, 1)), 1e-6);
  EXPECT_NEAR(row(rows, "pose_efficiency_heading").value, 4e-6 / bound(2, 2), 1e-6);
  EXPECT_NEAR(row(rows, "pose_nees").value, 1.0 + 4.0 + 1.0, 1e-6);
  EXPECT_EQ(row(rows, "pose_unmatched").value, 0.0);
  EXPECT_EQ(row(rows, "pose_unobservable").value, 0.0);
}

TEST(PoseEfficiency, NamesTheLargestErrorThatAMeanOverManyPairsHides) {
  MadeUpRun run = pose_seen_from(room(), {{}, {0.1, 0, 0}, {0.2, 0, 0}, {0.3, 0, 0}});
  run.result.matches = {{1, 0, {Status::converged, {0.1, 0.001, 0}, Eigen::Matrix3d::Identity()}},
                        {2, 1, {Status::converged, {0.4, -0.4, 0}, Eigen::Matrix3d::Identity()}},
                        {3, 2, {Status::no_match, {9, 9, 0}, Eigen::Matrix3d::Zero()}}};
  const auto rows = evaluate("pose_efficiency", run);
  EXPECT_NEAR(row(rows, "pose_error_position_max").value, 0.5, 1e-12);  // 3-4-5
  EXPECT_EQ(row(rows, "pose_error_position_max").count, 2);
}

TEST(PoseEfficiency, CountsAMuteMatchAsUnmatchedAndNotAsAnError) {
  MadeUpRun run = pose_seen_from(room(), {{}, {0.1, 0, 0}, {0.2, 0, 0}});
  run.result.matches = {{1, 0, {Status::converged, {0.1, 0, 0}, Eigen::Matrix3d::Identity()}},
                        {2, 1, {Status::degenerate, {9, 9, 1}, Eigen::Matrix3d::Identity()}}};
  const auto rows = evaluate("pose_efficiency", run);
  EXPECT_EQ(row(rows, "pose_unmatched").value, 0.5);
  EXPECT_EQ(row(rows, "pose_error_position").count, 1);
  EXPECT_NEAR(row(rows, "pose_error_position").value, 0.0, 1e-12);
}

}  // namespace
}  // namespace scanbench::test
