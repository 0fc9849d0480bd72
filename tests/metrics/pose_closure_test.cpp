// Closures of three matches: first-order covariances against differences, their distribution against draws.
#include "metrics/pose_closure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "core/geometry/pose_errors.hpp"
#include "tests/metrics/made_up.hpp"

namespace scanbench::metrics {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

/// The pose with errors of (x, y, yaw) along the axes of its reference, as Match states them.
Pose2 with_errors(const Pose2& pose, const Vector3d& e) {
  return {pose.x() + e.x(), pose.y() + e.y(), pose.yaw() + e.z()};
}

const Pose2 kFirst(0.4, -0.1, 0.3), kSecond(0.5, 0.2, -0.7), kBoth = kFirst * kSecond;

/// Three covariances of unlike shape, of millimetres and tenths of degrees.
Matrix3d covariance_of(double x_m, double y_m, double yaw_rad, double correlation) {
  const Vector3d sigmas(x_m, y_m, yaw_rad);
  Matrix3d c = sigmas.cwiseAbs2().asDiagonal();
  c(0, 2) = c(2, 0) = correlation * x_m * yaw_rad;
  c(0, 1) = c(1, 0) = -0.3 * x_m * y_m;
  return c;
}
const Matrix3d kOfFirst = covariance_of(0.004, 0.001, 0.0020, 0.5),
               kOfSecond = covariance_of(0.001, 0.003, 0.0005, 0.2),
               kOfBoth = covariance_of(0.002, 0.002, 0.0010, -0.4);

/// Draws matches of the three poses with independent normal errors.
class Draws {
 public:
  Match match(const Pose2& truth, const Matrix3d& covariance) {
    const Vector3d normal(normal_(generator_), normal_(generator_), normal_(generator_));
    const Vector3d error = Eigen::LLT<Matrix3d>(covariance).matrixL() * normal;
    return {.reference_from_current = with_errors(truth, error), .covariance = covariance};
  }

 private:
  std::mt19937_64 generator_{20261124};
  std::normal_distribution<double> normal_;
};

double squared_error(const Match& match, const Pose2& truth) {
  const Vector3d e = pose_error(match.reference_from_current, truth);
  return e.dot(match.covariance.inverse() * e);
}

TEST(PoseClosure, ComposedCovarianceIsThatOfDifferences) {
  constexpr double kStep = 1e-6;
  Matrix3d by_first, by_second;
  for (int k = 0; k < 3; ++k) {
    const Vector3d e = kStep * Vector3d::Unit(k);
    by_first.col(k) = pose_error(with_errors(kFirst, e) * kSecond, with_errors(kFirst, -e) * kSecond) / (2.0 * kStep);
    by_second.col(k) = pose_error(kFirst * with_errors(kSecond, e), kFirst * with_errors(kSecond, -e)) / (2.0 * kStep);
  }
  const Matrix3d expected = by_first * kOfFirst * by_first.transpose() + by_second * kOfSecond * by_second.transpose();
  const Matrix3d composed = composed_covariance(kFirst, kOfFirst, kSecond, kOfSecond);
  EXPECT_LT((composed - expected).norm(), 1e-8 * expected.norm());
}

TEST(PoseClosure, IsChiSquareWithThreeDegreesForIndependentErrorsAsNeesIs) {
  constexpr int kTriples = 20000;
  Draws draws;
  double closures = 0.0, nees = 0.0;
  int over = 0;
  std::vector<double> all;
  for (int i = 0; i < kTriples; ++i) {
    const Match first = draws.match(kFirst, kOfFirst), second = draws.match(kSecond, kOfSecond),
                both = draws.match(kBoth, kOfBoth);
    const auto closure = closure_of(first, second, both);
    ASSERT_TRUE(closure);
    ASSERT_EQ(closure->freedom, 3);
    closures += closure->square;
    over += closure->square > 16.266 ? 1 : 0;
    all.push_back(closure->square);
    nees += (squared_error(first, kFirst) + squared_error(second, kSecond) + squared_error(both, kBoth)) / 3.0;
  }
  const double deviation = std::sqrt(6.0 / kTriples);  // the variance of chi-square with three degrees is 6
  EXPECT_NEAR(closures / kTriples, 3.0, 4.0 * deviation);
  EXPECT_NEAR(closures / kTriples, nees / kTriples, 5.0 * deviation);
  EXPECT_NEAR(over, 20.0, 4.0 * std::sqrt(20.0));
  std::ranges::nth_element(all, all.begin() + kTriples / 2);
  EXPECT_NEAR(all[kTriples / 2], 2.366, 0.08);
}

TEST(PoseClosure, GrowsAsNeesDoesIfCovariancesAreTooSmall) {
  constexpr int kTriples = 5000;
  Draws draws;
  double closures = 0.0;
  for (int i = 0; i < kTriples; ++i) {
    Match first = draws.match(kFirst, kOfFirst), second = draws.match(kSecond, kOfSecond),
          both = draws.match(kBoth, kOfBoth);
    for (Match* match : {&first, &second, &both}) match->covariance /= 4.0;
    closures += closure_of(first, second, both)->square;
  }
  EXPECT_NEAR(closures / kTriples, 12.0, 4.0 * 4.0 * std::sqrt(6.0 / kTriples));
}

/// Along a corridor whose axis makes this angle with the reference's x axis: the guess decides there.
Matrix3d with_open_axis(const Matrix3d& covariance, double axis_rad) {
  const Vector3d axis(std::cos(axis_rad), std::sin(axis_rad), 0.0);
  return covariance + kOpenMotionM * kOpenMotionM * axis * axis.transpose();
}

TEST(PoseClosure, AnOpenMotionTakesADegreeOfFreedom) {
  constexpr int kTriples = 5000;
  const double axis = 0.8;                           // in the first scan; the second one sees it turned
  const double seen = axis - kFirst.yaw() + 0.0005;  // within what matchers know of it
  const Matrix3d isotropic = covariance_of(0.003, 0.003, 0.001, 0.0);
  Draws draws;
  double closures = 0.0;
  for (int i = 0; i < kTriples; ++i) {
    Match first = draws.match(kFirst, isotropic), second = draws.match(kSecond, isotropic),
          both = draws.match(kBoth, isotropic);
    const double off = 0.1 * std::sin(i);  // of the guess along the axis
    first.reference_from_current =
        with_errors(first.reference_from_current, off * Vector3d(std::cos(axis), std::sin(axis), 0.0));
    second.reference_from_current =
        with_errors(second.reference_from_current, -2.0 * off * Vector3d(std::cos(seen), std::sin(seen), 0.0));
    first.covariance = with_open_axis(isotropic, axis);
    second.covariance = with_open_axis(isotropic, seen);
    first.status = second.status = Status::degenerate;
    const auto closure = closure_of(first, second, both);
    ASSERT_TRUE(closure);
    ASSERT_EQ(closure->freedom, 2);
    closures += closure->square;
  }
  EXPECT_NEAR(closures / kTriples, 2.0, 4.0 * std::sqrt(4.0 / kTriples));
}

TEST(PoseClosure, TwoAxesThatDifferLeaveOneDegree) {
  const Matrix3d small = covariance_of(0.003, 0.003, 0.001, 0.0);
  const Match first{Status::degenerate, kFirst, with_open_axis(small, 0.0)},
      second{Status::degenerate, kSecond, with_open_axis(small, std::numbers::pi / 2 - kFirst.yaw())},
      both{Status::converged, with_errors(kBoth, {0.3, -0.2, 0.0}), small};
  const auto closure = closure_of(first, second, both);
  ASSERT_TRUE(closure);
  EXPECT_EQ(closure->freedom, 1);
  EXPECT_LT(closure->square, 1.0) << "headings agree";
}

TEST(PoseClosure, NeedsThreeCovariances) {
  const Match good{Status::converged, kFirst, kOfFirst}, none{Status::no_match, kFirst, Matrix3d::Zero()},
      silent{Status::converged, kFirst, Matrix3d::Zero()};
  EXPECT_TRUE(closure_of(good, good, good));
  for (const Match& bad : {none, silent}) {
    EXPECT_FALSE(closure_of(bad, good, good));
    EXPECT_FALSE(closure_of(good, bad, good));
    EXPECT_FALSE(closure_of(good, good, bad));
  }
}

TEST(PoseClosure, OfFewerDegreesIsComparedByItsProbability) {
  EXPECT_NEAR(as_three_degrees(13.816, 2), 16.266, 0.002);  // 99.9 % quantiles, printed tables
  EXPECT_NEAR(as_three_degrees(10.828, 1), 16.266, 0.002);
  EXPECT_NEAR(as_three_degrees(1.386, 2), 2.366, 0.001);  // medians
  EXPECT_EQ(as_three_degrees(7.0, 3), 7.0);
  EXPECT_GT(as_three_degrees(1e6, 2), 1e3) << "where no probability is left";
}

/// Matches of frames 1 to 4 with the last one and, of every other, with the last but one; the second triple errs by 10
/// standard deviations.
TEST(ClosureMetric, CountsTriplesThatHaveAllThreeMatches) {
  test::MadeUpRun run = test::make_run({}, {});
  const Matrix3d c = Vector3d(1e-6, 1e-6, 1e-6).asDiagonal();
  const auto matched = [&](int frame, int reference, double x) {
    return FrameMatch{frame, reference, {Status::converged, Pose2(x, 0, 0), c}};
  };
  run.result.matches = {matched(1, 0, 1), matched(2, 1, 1), matched(3, 2, 1), matched(4, 3, 1)};
  run.result.skip_matches = {matched(2, 0, 2), matched(4, 2, 2 + 10.0 * std::sqrt(3e-6))};
  run.result.skip_matches.push_back(matched(4, 2, 2));
  run.result.skip_matches.back().match.status = Status::no_match;
  const auto rows = test::family("closure")->evaluate(run.input_without_truth());
  EXPECT_DOUBLE_EQ(test::row(rows, "closure_over").value, 0.5);
  EXPECT_EQ(test::row(rows, "closure_over").count, 2);
  // Along x the variance is 3e-6, for nothing turns there: no lever across the path.
  EXPECT_NEAR(test::row(rows, "closure_mean").value, 0.5 * 100.0, 1e-6);
  EXPECT_NEAR(test::row(rows, "closure_counted").value, 2.0 / 3.0, 1e-12);
  EXPECT_EQ(test::row(rows, "closure_open").value, 0.0);
  run.result.skip_matches.clear();
  EXPECT_FALSE(test::family("closure")->applies(run.input_without_truth()));
}

}  // namespace
}  // namespace scanbench::metrics
