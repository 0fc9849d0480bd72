// Solution of the normal equations of all poses.
#include "algorithms/align/parts/joint_equations.hpp"

#include <algorithm>
#include <utility>

#include <Eigen/SparseCholesky>

#include "algorithms/align/parts/block_system.hpp"
#include "algorithms/align/parts/pose_equations.hpp"

namespace scanbench::align {
namespace {

// Share of the largest diagonal entry. The matrix is singular if scans determine each other but not their place as a
// group. The gradient has no component along such motions, and the damping keeps the solution zero there.
constexpr double kDamping = 1e-9;

// Up to this number of scans a factorization takes milliseconds.
constexpr std::size_t kFewScans = 200;

// A long chain of scans, each of which meets only its neighbours, needs as many iterations as it has scans. Its
// factorization takes milliseconds.
constexpr int kMostGradientSteps = 500;

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

double JointEquations::damping() const {
  double largest = 0.0;
  for (const Eigen::Matrix3d& block : diagonal_) largest = std::max(largest, block.diagonal().maxCoeff());
  return kDamping * largest;
}

std::vector<Eigen::Vector3d> JointEquations::solve(int& lowest_rank) const {
  const std::size_t n = diagonal_.size();
  // The unknowns are the observable motions of each scan; the first scan has none.
  std::vector<Observable> free(n);
  for (std::size_t k = 1; k < n; ++k) {
    free[k] = observable(diagonal_[k]);
    lowest_rank = std::min(lowest_rank, free[k].rank());
  }
  if (n > kFewScans)
    if (const auto motions = iterated(free)) return *motions;
  return factorized(free);
}

std::vector<Eigen::Vector3d> JointEquations::factorized(const std::vector<Observable>& free) const {
  const std::size_t n = diagonal_.size();
  std::vector<Eigen::Vector3d> motions(n, Eigen::Vector3d::Zero());
  std::vector<Eigen::Index> begin(n + 1, 0);
  for (std::size_t k = 0; k < n; ++k) begin[k + 1] = begin[k] + free[k].rank();
  const Eigen::Index unknowns = begin[n];
  if (unknowns == 0) return motions;

  std::vector<Eigen::Triplet<double>> entries;
  const auto put = [&](std::size_t i, std::size_t j, const Eigen::Matrix3d& block) {
    const Eigen::MatrixXd reduced = free[i].motions.transpose() * block * free[j].motions;
    for (Eigen::Index c = 0; c < reduced.cols(); ++c)
      for (Eigen::Index r = 0; r < reduced.rows(); ++r) entries.emplace_back(begin[i] + r, begin[j] + c, reduced(r, c));
  };
  for (std::size_t k = 0; k < n; ++k) put(k, k, diagonal_[k]);
  for (const Block& block : blocks_) put(block.row, block.column, block.value);
  const double damped = damping();
  for (Eigen::Index u = 0; u < unknowns; ++u) entries.emplace_back(u, u, damped);
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());

  Eigen::VectorXd right(unknowns);
  for (std::size_t k = 0; k < n; ++k)
    right.segment(begin[k], free[k].rank()) = -(free[k].motions.transpose() * gradient_[k]);
  const Eigen::VectorXd solution = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right);
  for (std::size_t k = 0; k < n; ++k) motions[k] = free[k].motions * solution.segment(begin[k], free[k].rank());
  return motions;
}

std::optional<std::vector<Eigen::Vector3d>> JointEquations::iterated(const std::vector<Observable>& free) const {
  const std::size_t n = diagonal_.size();
  // Every scan has three unknowns here. The rows of motions that are held say only that they are zero.
  std::vector<Eigen::Matrix3d> onto(n), diagonal(n);
  std::vector<Eigen::Vector3d> right(n);
  const double damped = damping();
  for (std::size_t k = 0; k < n; ++k) {
    onto[k] = free[k].rank() == 3 ? Eigen::Matrix3d(Eigen::Matrix3d::Identity())
                                  : Eigen::Matrix3d(free[k].motions * free[k].motions.transpose());
    diagonal[k] = onto[k] * diagonal_[k] * onto[k] + Eigen::Matrix3d::Identity() - onto[k];
    diagonal[k].diagonal().array() += damped;
    right[k] = -(onto[k] * gradient_[k]);
  }
  std::vector<LowerBlock> lower;
  lower.reserve(blocks_.size());
  for (const Block& block : blocks_)
    if (free[block.row].rank() > 0 && free[block.column].rank() > 0)
      lower.push_back({block.row, block.column, onto[block.row] * block.value * onto[block.column]});
  return BlockSystem(std::move(diagonal), lower).solve(right, kMostGradientSteps);
}

}  // namespace scanbench::align
