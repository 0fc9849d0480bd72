// trajectory: paths whose errors are known.
#include <cmath>
#include <limits>

#include "core/geometry/plane_alignment.hpp"
#include "tests/metrics/made_up.hpp"

namespace scanbench::test {
namespace {

MadeUpRun run_of(const std::vector<Pose2>& truth, const std::vector<Pose2>& estimated) {
  MadeUpRun run;
  run.observed.frames.resize(truth.size());
  run.truth.world_from_sensor = truth;
  run.result.world_from_sensor = estimated;
  return run;
}

std::vector<Pose2> moved(const Pose2& by, const std::vector<Pose2>& path) {
  std::vector<Pose2> result;
  for (const Pose2& p : path) result.push_back(by * p);
  return result;
}

std::vector<Pose2> straight_path() {
  std::vector<Pose2> path;
  for (int k = 0; k < 11; ++k) path.emplace_back(0.3 * k, 0.0, 0.0);
  return path;
}

std::vector<Pose2> curve() {
  std::vector<Pose2> path{{0, 0, 0}};
  for (int k = 0; k < 20; ++k) path.push_back(path.back() * Pose2(0.25, 0.02 * (k % 3), 0.2));
  return path;
}

TEST(Trajectory, OfARigidlyMovedPathHasNoError) {
  const std::vector<Pose2> standing(5, Pose2(1, 2, 0.3));
  for (const auto& path : {straight_path(), curve(), standing})
    for (const double turn : {0.0, 0.7, 3.1, -2.0}) {
      const auto rows = evaluate("trajectory", run_of(path, moved({4, -3, turn}, path)));
      EXPECT_NEAR(row(rows, "ate_position").value, 0.0, 1e-12);
      EXPECT_NEAR(row(rows, "ate_heading_max").value, 0.0, 1e-10);
      EXPECT_NEAR(row(rows, "rpe_position").value, 0.0, 1e-12);
      EXPECT_NEAR(row(rows, "rpe_heading").value, 0.0, 1e-10);
    }
}

TEST(Trajectory, IsNeverScaled) {
  std::vector<Pose2> longer;
  for (const Pose2& p : straight_path()) longer.emplace_back(1.1 * p.x(), p.y(), p.yaw());
  const auto rows = evaluate("trajectory", run_of(straight_path(), longer));
  // Errors are 0.03 (k - 5), k = 0 .. 10: mean square 0.0009 * 110 / 11.
  EXPECT_NEAR(row(rows, "ate_position").value, 0.03 * std::sqrt(10.0), 1e-12);
  EXPECT_NEAR(row(rows, "ate_position_max").value, 0.15, 1e-12);
  EXPECT_NEAR(row(rows, "ate_position_mean").value, 0.03 * 30.0 / 11.0, 1e-12);
  EXPECT_NEAR(row(rows, "rpe_position").value, 0.03, 1e-12);
  // Four steps of 0.3 m are the first to make a metre.
  EXPECT_NEAR(row(rows, "rpe_path_position").value, 0.12, 1e-9);
  EXPECT_EQ(row(rows, "rpe_path_position").count, 7);
}

TEST(Trajectory, KeepsTurnsApartFromShifts) {
  std::vector<Pose2> estimated{{0, 0, 0}};
  const std::vector<Pose2> truth = straight_path();
  for (std::size_t k = 1; k < truth.size(); ++k)
    estimated.push_back(estimated.back() * (truth[k - 1].inverse() * truth[k]) * Pose2(0, 0, radians(0.5)));
  const auto rows = evaluate("trajectory", run_of(truth, estimated));
  EXPECT_NEAR(row(rows, "rpe_heading").value, 0.5, 1e-9);
  EXPECT_NEAR(row(rows, "rpe_position").value, 0.0, 1e-12);
  EXPECT_GT(row(rows, "ate_position").value, 0.01);
}

TEST(Trajectory, NeedsAPoseForEveryTrueOne) {
  EXPECT_FALSE(family("trajectory")->applies(run_of(straight_path(), curve()).input()));
  EXPECT_FALSE(family("trajectory")->applies(run_of(straight_path(), {}).input()));
  EXPECT_FALSE(family("trajectory")->applies(run_of(curve(), curve()).input_without_truth()));
  EXPECT_TRUE(family("trajectory")->applies(run_of(curve(), curve()).input()));
}

TEST(Trajectory, OfALogIsComparedWithItsReferencePosesBesideTheOdometry) {
  MadeUpRun run = run_of(straight_path(), straight_path());
  for (std::size_t k = 0; k < run.observed.frames.size(); ++k)
    run.observed.frames[k].odom_from_sensor = Pose2(0.35 * static_cast<double>(k), 0, 0);
  const ReferencePoses reference{straight_path(), {}};
  metrics::MetricInput input = run.input_without_truth();
  input.reference = &reference;
  ASSERT_TRUE(family("trajectory")->applies(input));
  const auto rows = family("trajectory")->evaluate(input);
  EXPECT_NEAR(row(rows, "rpe_position").value, 0.0, 1e-12);
  EXPECT_NEAR(row(rows, "rpe_odometry_position").value, 0.05, 1e-12);
  EXPECT_NEAR(row(rows, "rpe_odometry_heading").value, 0.0, 1e-12);
  // Errors of 5 cm times (k - mean of k): the variance of n numbers in a row is (n^2 - 1) / 12.
  const auto n = static_cast<double>(run.observed.frames.size());
  EXPECT_NEAR(row(rows, "ate_odometry_position").value, 0.05 * std::sqrt((n * n - 1) / 12), 1e-9);
  EXPECT_NEAR(row(rows, "ate_odometry_heading").value, 0.0, 1e-9);
}

TEST(Trajectory, RelationsGiveTheMeanAndMeanSquareOfTheDeviations) {
  MadeUpRun run = run_of(straight_path(), straight_path());
  for (std::size_t k = 0; k < run.observed.frames.size(); ++k) run.observed.frames[k].odom_from_sensor = Pose2();
  // Deviations of 0.1 and 0.3 m, 0 and 2 degrees; the odometry stays, so that its deviations are the relations.
  const ReferencePoses reference{{}, {{0, 1, {0.4, 0, 0}}, {3, 1, {-0.6, -0.3, radians(2)}}}};
  metrics::MetricInput input = run.input_without_truth();
  input.reference = &reference;
  ASSERT_TRUE(family("trajectory")->applies(input));
  const auto rows = family("trajectory")->evaluate(input);
  EXPECT_NEAR(row(rows, "relations_position").value, 0.2, 1e-12);
  EXPECT_EQ(row(rows, "relations_position").count, 2);
  EXPECT_NEAR(row(rows, "relations_position_square").value, 0.05, 1e-12);
  EXPECT_NEAR(row(rows, "relations_heading").value, 1.0, 1e-9);
  EXPECT_NEAR(row(rows, "relations_heading_square").value, 2.0, 1e-9);
  EXPECT_NEAR(row(rows, "relations_odometry_position").value, 0.5 * (0.4 + std::hypot(0.6, 0.3)), 1e-12);
  for (const auto& r : rows) EXPECT_FALSE(r.metric.starts_with("rpe")) << r.metric;
}

TEST(PlaneAlignment, IsThatOfThePositionsWhereTheyDecide) {
  // Headings that are wrong by a constant: they pull with the square of the lever only.
  std::vector<Pose2> turned;
  for (const Pose2& p : curve()) turned.push_back(p * Pose2(0, 0, 0.5));
  const Pose2 found = align_trajectories(turned, curve(), 1e-3);
  EXPECT_NEAR(found.yaw(), 0.0, 1e-5);
  EXPECT_LT(found.translation().norm(), 1e-5);
}

}  // namespace
}  // namespace scanbench::test
