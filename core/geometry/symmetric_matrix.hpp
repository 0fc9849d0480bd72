// Eigenvalues and inverses of symmetric matrices. Eigen's solvers are compiled here once, and not in each caller.
#pragma once

#include <Eigen/Core>

namespace scanbench {

/// Eigenvalues in ascending order, and their unit eigenvectors as columns in the same order.
template <class Matrix>
struct SymmetricEigen {
  Eigen::Matrix<double, Matrix::RowsAtCompileTime, 1> values;
  Matrix vectors;
};

/// Eigenvalues and eigenvectors of a symmetric matrix, of which only the lower triangle is read. A matrix that is not
/// finite gives values that are not. Iterative: accurate to a few ulp of the largest eigenvalue.
SymmetricEigen<Eigen::Matrix2d> symmetric_eigen(const Eigen::Matrix2d& matrix);
SymmetricEigen<Eigen::Matrix3d> symmetric_eigen(const Eigen::Matrix3d& matrix);
SymmetricEigen<Eigen::MatrixXd> symmetric_eigen(const Eigen::MatrixXd& matrix);

/// In closed form: several times faster, with errors of about the square root of the machine's precision where
/// eigenvalues nearly coincide.
SymmetricEigen<Eigen::Matrix3d> fast_symmetric_eigen(const Eigen::Matrix3d& matrix);

/// The eigenvalues alone, ascending.
Eigen::Vector2d symmetric_eigenvalues(const Eigen::Matrix2d& matrix);
Eigen::Vector3d symmetric_eigenvalues(const Eigen::Matrix3d& matrix);

/// Solution of a positive definite system, by LDL^T with pivoting.
Eigen::VectorXd solve_definite(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

/// Inverse of a positive definite matrix, by Cholesky's decomposition.
Eigen::MatrixXd inverse_of_definite(const Eigen::MatrixXd& matrix);

}  // namespace scanbench
