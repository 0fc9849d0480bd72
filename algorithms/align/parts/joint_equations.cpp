// Solution of the normal equations of all poses.
#include "algorithms/align/parts/joint_equations.hpp"

#include <algorithm>

#include <Eigen/SparseCholesky>

#include "algorithms/align/parts/pose_equations.hpp"

namespace scanbench::align {
namespace {

// Share of the largest diagonal entry. The matrix is singular if scans determine each other but not their place as a
// group. The gradient has no component along such motions, and the damping keeps the solution zero there.
constexpr double kDamping = 1e-9;

}  // namespace

void JointEquations::finish(std::size_t i) {
  for (std::size_t j = 0; j < row_.size(); ++j) {
    if (shared_[j] == 0) continue;
    if (i > j) blocks_.push_back({i, j, row_[j], shared_[j]});
    if (i < j) blocks_.push_back({j, i, row_[j].transpose(), shared_[j]});
    row_[j].setZero();
    shared_[j] = 0;
  }
}

ScanGroups JointEquations::groups(int fewest) const {
  ScanGroups groups(diagonal_.size());
  for (const Block& block : blocks_)
    if (block.residuals >= fewest) groups.join(block.row, block.column);
  return groups;
}

std::vector<Eigen::Vector3d> JointEquations::solve(int& lowest_rank) const {
  const std::size_t n = diagonal_.size();
  std::vector<Eigen::Vector3d> motions(n, Eigen::Vector3d::Zero());
  // The unknowns are the observable motions of each scan; the first scan has none.
  std::vector<Observable> free(n);
  std::vector<Eigen::Index> begin(n + 1, 0);
  for (std::size_t k = 1; k < n; ++k) {
    free[k] = observable(diagonal_[k]);
    lowest_rank = std::min(lowest_rank, free[k].rank());
    begin[k + 1] = begin[k] + free[k].rank();
  }
  const Eigen::Index unknowns = begin[n];
  if (unknowns == 0) return motions;

  std::vector<Eigen::Triplet<double>> entries;
  const auto put = [&](std::size_t i, std::size_t j, const Eigen::Matrix3d& block) {
    const Eigen::MatrixXd reduced = free[i].motions.transpose() * block * free[j].motions;
    for (Eigen::Index c = 0; c < reduced.cols(); ++c)
      for (Eigen::Index r = 0; r < reduced.rows(); ++r) entries.emplace_back(begin[i] + r, begin[j] + c, reduced(r, c));
  };
  double largest = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    put(k, k, diagonal_[k]);
    largest = std::max(largest, diagonal_[k].diagonal().maxCoeff());
  }
  for (const Block& block : blocks_) put(block.row, block.column, block.value);
  for (Eigen::Index u = 0; u < unknowns; ++u) entries.emplace_back(u, u, kDamping * largest);
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());

  Eigen::VectorXd right(unknowns);
  for (std::size_t k = 0; k < n; ++k)
    right.segment(begin[k], free[k].rank()) = -(free[k].motions.transpose() * gradient_[k]);
  const Eigen::VectorXd solution = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right);
  for (std::size_t k = 0; k < n; ++k) motions[k] = free[k].motions * solution.segment(begin[k], free[k].rank());
  return motions;
}

}  // namespace scanbench::align
