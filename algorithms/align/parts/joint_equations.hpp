// Normal equations of the poses of all scans, and their solution along the motions that they determine.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "algorithms/align/parts/pose_equations.hpp"
#include "algorithms/align/parts/scan_groups.hpp"

namespace scanbench::align {

/// Normal equations of all scans in blocks of three unknowns.
class JointEquations {
 public:
  explicit JointEquations(std::size_t scans)
      : diagonal_(scans, Eigen::Matrix3d::Zero()),
        gradient_(scans, Eigen::Vector3d::Zero()),
        row_(scans, Eigen::Matrix3d::Zero()),
        shared_(scans, 0) {}

  /// Adds a residual of scans i and j with its derivatives by their poses.
  void add(std::size_t i, const Eigen::Vector3d& row_i, std::size_t j, const Eigen::Vector3d& row_j, double residual,
           double weight) {
    diagonal_[i] += weight * row_i * row_i.transpose();
    diagonal_[j] += weight * row_j * row_j.transpose();
    gradient_[i] += weight * residual * row_i;
    gradient_[j] += weight * residual * row_j;
    row_[j] += weight * row_i * row_j.transpose();
    ++shared_[j];
  }

  /// To be called after the last residual whose first scan is i.
  void finish(std::size_t i);

  /// Motions of all scans; that of the first is zero. `lowest_rank` is lowered to the smallest rank of the others. Up
  /// to 200 scans by sparse Cholesky factorization. More scans by conjugate gradients, whose result differs by a
  /// relative 1e-10, unless they take more than 500 iterations.
  std::vector<Eigen::Vector3d> solve(int& lowest_rank) const;

  /// Groups of scans; two scans meet if at least `fewest` residuals join them.
  ScanGroups groups(int fewest) const;

 private:
  struct Block {
    std::size_t row;
    std::size_t column;  ///< below `row`
    Eigen::Matrix3d value;
    int residuals;
  };

  double damping() const;
  std::vector<Eigen::Vector3d> factorized(const std::vector<Observable>& free) const;
  std::optional<std::vector<Eigen::Vector3d>> iterated(const std::vector<Observable>& free) const;

  std::vector<Eigen::Matrix3d> diagonal_;
  std::vector<Eigen::Vector3d> gradient_;
  std::vector<Eigen::Matrix3d> row_;
  std::vector<int> shared_;
  std::vector<Block> blocks_;
};

}  // namespace scanbench::align
