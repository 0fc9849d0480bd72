// Errors and covariances of composed poses, and what is left of them beside open motions.
#include "metrics/pose_closure.hpp"

#include <array>
#include <cmath>

#include <Eigen/LU>

#include "core/distributions.hpp"
#include "core/geometry/pose_errors.hpp"
#include "core/geometry/symmetric_matrix.hpp"

namespace scanbench::metrics {
namespace {

using Eigen::Matrix3d;

constexpr double kClosureLeverM = 3.0;  // metres of motion per radian where motions are compared
// A motion with a larger standard deviation is open. Matchers give open ones kOpenMotionM with a lever of their own.
constexpr double kOpenM = 0.05 * kOpenMotionM;
// What an open motion is taken to err by. With kOpenMotionM, an angle of 1e-3 between the open motions of two matches
// would leave the motion across them unknown to decimetres.
constexpr double kOpenErrorM = 1.0;
// Open motions of two matches are one if they differ by less than some 15 degrees.
constexpr double kLeastOpen = 0.05;

Matrix3d in_lever_units(const Matrix3d& covariance, double lever_m) {
  const Eigen::Vector3d scales(1.0, 1.0, lever_m);
  return scales.asDiagonal() * covariance * scales.asDiagonal();
}

/// A covariance without the arbitrary size of its open motions.
struct Stated {
  explicit Stated(const Match& match) {
    SymmetricEigen<Matrix3d> eigen = symmetric_eigen(in_lever_units(match.covariance, kClosureLeverM));
    Eigen::Vector3d is_open = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
      if (eigen.values(k) > kOpenM * kOpenM) {
        is_open(k) = 1.0;
        eigen.values(k) = kOpenErrorM * kOpenErrorM;
      }
    covariance =
        in_lever_units(eigen.vectors * eigen.values.asDiagonal() * eigen.vectors.transpose(), 1.0 / kClosureLeverM);
    open = in_lever_units(eigen.vectors * is_open.asDiagonal() * eigen.vectors.transpose(), 1.0 / kClosureLeverM);
  }
  Matrix3d covariance;
  Matrix3d open;  ///< unit variance along each open motion
};

bool states_covariance(const Match& match) {
  return match.status != Status::no_match && match.covariance.allFinite() && match.covariance.determinant() > 0;
}

}  // namespace

Matrix3d composed_covariance(const Pose2& a_from_b, const Matrix3d& of_a_from_b, const Pose2& b_from_c,
                             const Matrix3d& of_b_from_c) {
  Matrix3d by_first = Matrix3d::Identity(), by_second = Matrix3d::Identity();
  by_first.topRightCorner<2, 1>() = perpendicular(a_from_b.rotate(b_from_c.translation()));
  by_second.topLeftCorner<2, 2>() << a_from_b.cos(), -a_from_b.sin(), a_from_b.sin(), a_from_b.cos();
  return by_first * of_a_from_b * by_first.transpose() + by_second * of_b_from_c * by_second.transpose();
}

std::optional<Closure> closure_of(const Match& first, const Match& second, const Match& both) {
  for (const Match* match : {&first, &second, &both})
    if (!states_covariance(*match)) return std::nullopt;
  const Pose2 &a_from_b = first.reference_from_current, &b_from_c = second.reference_from_current;
  const Stated of_first(first), of_second(second), of_both(both);
  const Matrix3d covariance =
      composed_covariance(a_from_b, of_first.covariance, b_from_c, of_second.covariance) + of_both.covariance;
  const Matrix3d open = composed_covariance(a_from_b, of_first.open, b_from_c, of_second.open) + of_both.open;

  const SymmetricEigen<Matrix3d> motions = symmetric_eigen(in_lever_units(open, kClosureLeverM));
  int freedom = 0;
  while (freedom < 3 && motions.values(freedom) < kLeastOpen) ++freedom;
  if (freedom == 0) return std::nullopt;
  Closure closure{.error = pose_error(a_from_b * b_from_c, both.reference_from_current), .freedom = freedom};
  const Eigen::Vector3d metres = closure.error.cwiseProduct(Eigen::Vector3d(1.0, 1.0, kClosureLeverM));
  const Eigen::MatrixXd known = motions.vectors.leftCols(freedom);
  const Eigen::VectorXd error = known.transpose() * metres;
  closure.square =
      error.dot(solve_definite(known.transpose() * in_lever_units(covariance, kClosureLeverM) * known, error));
  return closure;
}

double as_three_degrees(double square, int freedom) {
  if (freedom == 3) return square;
  constexpr double kLeast = 1e-300;  // probabilities below it have no digits left
  const double exceeded = chi_square_upper(square, freedom);
  return exceeded > kLeast ? chi_square_upper_quantile(exceeded, 3.0) : square;
}

}  // namespace scanbench::metrics
