// Eigenvalues and inverses against matrices that are built from known ones.
#include "core/geometry/symmetric_matrix.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace scanbench {
namespace {

Eigen::Matrix3d with_eigenvalues(const Eigen::Vector3d& values, const Eigen::Matrix3d& axes) {
  return axes * values.asDiagonal() * axes.transpose();
}

const Eigen::Matrix3d kAxes = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix();

TEST(SymmetricMatrix, ValuesAreAscendingAndVectorsBelongToThem) {
  const Eigen::Vector3d values(-1.5, 0.25, 4.0);
  const Eigen::Matrix3d matrix = with_eigenvalues(values, kAxes);
  for (const auto& eigen : {symmetric_eigen(matrix), fast_symmetric_eigen(matrix)}) {
    EXPECT_LT((eigen.values - values).norm(), 1e-12);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(std::abs(eigen.vectors.col(k).dot(kAxes.col(k))), 1.0, 1e-12);
  }
  EXPECT_LT((symmetric_eigenvalues(matrix) - values).norm(), 1e-12);
  const auto general = symmetric_eigen(Eigen::MatrixXd(matrix));
  EXPECT_LT((general.values - values).norm(), 1e-12);
}

TEST(SymmetricMatrix, OfTwoRowsHasTheRootsOfItsPolynomial) {
  Eigen::Matrix2d matrix;
  matrix << 2.0, -1.0, -1.0, 3.0;  // x^2 - 5 x + 5 = 0
  const Eigen::Vector2d roots((5 - std::sqrt(5.0)) / 2, (5 + std::sqrt(5.0)) / 2);
  EXPECT_LT((symmetric_eigenvalues(matrix) - roots).norm(), 1e-14);
  const auto eigen = symmetric_eigen(matrix);
  EXPECT_LT((matrix * eigen.vectors.col(1) - roots(1) * eigen.vectors.col(1)).norm(), 1e-14);
}

TEST(SymmetricMatrix, OfEqualEigenvaluesHasThreeOrthogonalAxes) {
  const auto eigen = symmetric_eigen(Eigen::Matrix3d(2.0 * Eigen::Matrix3d::Identity()));
  EXPECT_LT((eigen.vectors.transpose() * eigen.vectors - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_EQ(eigen.values, Eigen::Vector3d(2, 2, 2));
}

TEST(SymmetricMatrix, ASolutionAndAnInverseGiveBackTheRightSide) {
  const Eigen::MatrixXd matrix = with_eigenvalues({0.5, 2.0, 8.0}, kAxes);
  const Eigen::VectorXd right = Eigen::Vector3d(1, -4, 2);
  EXPECT_LT((matrix * solve_definite(matrix, right) - right).norm(), 1e-13);
  EXPECT_LT((matrix * inverse_of_definite(matrix) - Eigen::MatrixXd::Identity(3, 3)).norm(), 1e-13);
}

}  // namespace
}  // namespace scanbench
