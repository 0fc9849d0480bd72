// Total least squares against the eigenvalues of the covariance matrix and its invariances.
#include "core/geometry/least_squares.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/rng.hpp"

namespace scanbench {
namespace {

std::vector<Vec2> cloud(std::uint64_t seed, int n) {
  CounterRng rng(seed, RngStream::pose);
  const Pose2 pose(3 * rng.normal(), 3 * rng.normal(), kTwoPi * rng.uniform());
  std::vector<Vec2> points;
  for (int i = 0; i < n; ++i) points.push_back(pose * Vec2(4 * rng.uniform(), 0.05 * rng.normal()));
  return points;
}

TEST(FitLine, LeavesNTimesTheSmallerEigenvalueOfTheCovariance) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const auto points = cloud(seed, 40);
    Vec2 mean = Vec2::Zero();
    for (const auto& p : points) mean += p / 40.0;
    Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
    for (const auto& p : points) scatter += (p - mean) * (p - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(scatter);
    const LineFit fit = fit_line(points);
    EXPECT_NEAR(fit.residual_sum, solver.eigenvalues()(0), 1e-12);
    EXPECT_NEAR(std::abs(fit.normal.dot(solver.eigenvectors().col(0))), 1.0, 1e-12);
    EXPECT_NEAR(fit.distance(mean), 0.0, 1e-13);
  }
}

TEST(FitLine, HasNoResidualOnCollinearPoints) {
  std::vector<Vec2> points;
  for (int i = 0; i < 20; ++i) points.emplace_back(100 + 0.3 * i, -50 + 0.7 * i);
  const LineFit fit = fit_line(points);
  EXPECT_FALSE(fit.degenerate);
  EXPECT_NEAR(fit.rms(), 0.0, 1e-6);
  for (const auto& p : points) EXPECT_NEAR(fit.distance(p), 0.0, 1e-12);
}

TEST(FitLine, MovesWithTheRigidMotionOfItsPoints) {
  const auto points = cloud(9, 30);
  const Pose2 motion(5, -7, 2.5);
  std::vector<Vec2> moved;
  for (const auto& p : points) moved.push_back(motion * p);
  const auto d = line_difference(fit_line(moved).polar(), transform(motion, fit_line(points).polar()));
  EXPECT_NEAR(d.rho, 0.0, 1e-12);
  EXPECT_NEAR(d.alpha, 0.0, 1e-12);
}

TEST(FitLine, ReportsAnUndefinedDirection) {
  EXPECT_TRUE(fit_line(std::vector<Vec2>{}).degenerate);
  EXPECT_TRUE(fit_line(std::vector<Vec2>{{1, 2}}).degenerate);
  EXPECT_TRUE(fit_line(std::vector<Vec2>{{1, 2}, {1, 2}, {1, 2}}).degenerate);
  EXPECT_TRUE(fit_line(std::vector<Vec2>{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}).degenerate);
}

TEST(FitLine, FindsAxisParallelLinesOfBothKinds) {
  EXPECT_NEAR(std::abs(fit_line(std::vector<Vec2>{{1, 0}, {1, 5}}).normal.x()), 1.0, 1e-15);
  EXPECT_NEAR(std::abs(fit_line(std::vector<Vec2>{{0, 1}, {5, 1}}).normal.y()), 1.0, 1e-15);
}

TEST(PointMoments, OfAUnionAreTheSumOfTheParts) {
  const auto points = cloud(4, 50);
  PointMoments left, right, whole;
  for (std::size_t i = 0; i < points.size(); ++i) {
    (i < 17 ? left : right).add(points[i], 1.0 + static_cast<double>(i % 3));
    whole.add(points[i], 1.0 + static_cast<double>(i % 3));
  }
  left.add(right);
  EXPECT_NEAR(left.weight(), whole.weight(), 1e-12);
  EXPECT_NEAR((left.centroid() - whole.centroid()).norm(), 0.0, 1e-13);
  EXPECT_NEAR(left.sxx(), whole.sxx(), 1e-11);
  EXPECT_NEAR(left.sxy(), whole.sxy(), 1e-11);
  EXPECT_NEAR(left.syy(), whole.syy(), 1e-11);
}

}  // namespace
}  // namespace scanbench
