// Assembly and solution of the normal equations of all poses.
#include "algorithms/align/point_to_line/joint_step.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/SparseCholesky>

#include "core/index.hpp"

namespace scanbench::align {
namespace {

// Damping relative to the largest diagonal entry. Scans that determine each other, but not their place as a group,
// would make the matrix singular. The gradient along such motions is zero, so the damped solution does not move the
// group.
constexpr double kDamping = 1e-9;

/// Normal equations of all scans in blocks of three unknowns.
class JointEquations {
 public:
  explicit JointEquations(std::size_t scans)
      : diagonal_(scans, Eigen::Matrix3d::Zero()),
        gradient_(scans, Eigen::Vector3d::Zero()),
        row_(scans, Eigen::Matrix3d::Zero()) {}

  void add(std::size_t i, const Eigen::Vector3d& row_i, std::size_t j, const Eigen::Vector3d& row_j, double residual,
           double weight) {
    diagonal_[i] += weight * row_i * row_i.transpose();
    diagonal_[j] += weight * row_j * row_j.transpose();
    gradient_[i] += weight * residual * row_i;
    gradient_[j] += weight * residual * row_j;
    row_[j] += weight * row_i * row_j.transpose();
  }

  /// Call after the last pair with readings of scan i.
  void finish(std::size_t i) {
    for (std::size_t j = 0; j < row_.size(); ++j) {
      if (row_[j].isZero(0.0)) continue;
      if (i > j) blocks_.push_back({i, j, row_[j]});
      if (i < j) blocks_.push_back({j, i, row_[j].transpose()});
      row_[j].setZero();
    }
  }

  /// Motions of all scans; that of the first is zero. Lowers `lowest_rank` to the smallest rank among the others.
  std::vector<Eigen::Vector3d> solve(int& lowest_rank) const;

 private:
  struct Block {
    std::size_t row;
    std::size_t column;  ///< below `row`
    Eigen::Matrix3d value;
  };

  std::vector<Eigen::Matrix3d> diagonal_;
  std::vector<Eigen::Vector3d> gradient_;
  std::vector<Eigen::Matrix3d> row_;
  std::vector<Block> blocks_;
};

std::vector<Eigen::Vector3d> JointEquations::solve(int& lowest_rank) const {
  const std::size_t n = diagonal_.size();
  std::vector<Eigen::Vector3d> motions(n, Eigen::Vector3d::Zero());
  // Unknowns are the observable motions of each scan; the first has none.
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

}  // namespace

JointStep joint_step(std::span<const ScanShape> scans, const PartnerRules& rules, double longest_m,
                     std::vector<Pose2>& world_from_sensor) {
  LineGrid grid(rules, longest_m);
  for (std::size_t k = 0; k < scans.size(); ++k) grid.add(static_cast<int>(k), world_from_sensor[k], scans[k].lines);

  JointStep step;
  JointEquations equations(scans.size());
  double squares = 0.0, weights = 0.0;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    for (const Reading& reading : scans[i].readings) {
      const Sighting seen = placed(reading, world_from_sensor[i]);
      grid.for_each_nearest(seen, rules, [&](const PlacedLine& line, double distance) {
        const auto j = as_index(line.scan);
        if (i == j) return;
        const Vec2 normal = perpendicular(line.direction);
        const double weight = tukey_weight(distance, rules.gate_m);
        equations.add(i, jacobian_row(normal, seen.point, seen.sensor, scans[i].lever_m), j,
                      -jacobian_row(normal, seen.point, world_from_sensor[j].translation(), scans[j].lever_m), distance,
                      weight);
        squares += weight * distance * distance;
        weights += weight;
        ++step.pairs;
      });
    }
    equations.finish(i);
  }
  if (weights > 0) step.rms_m = std::sqrt(squares / weights);

  const std::vector<Eigen::Vector3d> motions = equations.solve(step.lowest_rank);
  for (std::size_t k = 1; k < scans.size(); ++k) {
    const Move move = move_by(motions[k], scans[k].lever_m, world_from_sensor[k]);
    step.largest.shift_m = std::max(step.largest.shift_m, move.shift_m);
    step.largest.turn_rad = std::max(step.largest.turn_rad, move.turn_rad);
  }
  return step;
}

}  // namespace scanbench::align
