// Eigen's solvers of symmetric matrices.
#include "core/geometry/symmetric_matrix.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace scanbench {
namespace {

template <class Matrix>
SymmetricEigen<Matrix> solved(const Matrix& matrix) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template <class Matrix>
auto values_of(const Matrix& matrix) {
  return Eigen::SelfAdjointEigenSolver<Matrix>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace

SymmetricEigen<Eigen::Matrix2d> symmetric_eigen(const Eigen::Matrix2d& matrix) {
  return solved(matrix);
}

SymmetricEigen<Eigen::Matrix3d> symmetric_eigen(const Eigen::Matrix3d& matrix) {
  return solved(matrix);
}

SymmetricEigen<Eigen::MatrixXd> symmetric_eigen(const Eigen::MatrixXd& matrix) {
  return solved(matrix);
}

SymmetricEigen<Eigen::Matrix3d> fast_symmetric_eigen(const Eigen::Matrix3d& matrix) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::Vector2d symmetric_eigenvalues(const Eigen::Matrix2d& matrix) {
  return values_of(matrix);
}

Eigen::Vector3d symmetric_eigenvalues(const Eigen::Matrix3d& matrix) {
  return values_of(matrix);
}

Eigen::VectorXd solve_definite(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  return matrix.ldlt().solve(right);
}

Eigen::MatrixXd inverse_of_definite(const Eigen::MatrixXd& matrix) {
  return matrix.llt().solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols()));
}

}  // namespace scanbench
