// Rows of 3 x 3 blocks, and the iterations of conjugate gradients.
#include "algorithms/align/parts/block_system.hpp"

#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include <Eigen/LU>

namespace scanbench::align {
namespace {

constexpr double kResidual = 1e-10;

using Vectors = std::vector<Eigen::Vector3d>;

double dot(const Vectors& a, const Vectors& b) {
  return std::transform_reduce(a.begin(), a.end(), b.begin(), 0.0, std::plus<>(),
                               [](const Eigen::Vector3d& u, const Eigen::Vector3d& v) { return u.dot(v); });
}

/// y = x + factor * y
void scale_and_add(double factor, const Vectors& x, Vectors& y) {
  for (std::size_t k = 0; k < y.size(); ++k) y[k] = x[k] + factor * y[k];
}

/// y = y + factor * x
void add_scaled(double factor, const Vectors& x, Vectors& y) {
  for (std::size_t k = 0; k < y.size(); ++k) y[k] += factor * x[k];
}

}  // namespace

BlockSystem::BlockSystem(std::vector<Eigen::Matrix3d> diagonal, std::span<const LowerBlock> lower)
    : diagonal_(std::move(diagonal)) {
  const std::size_t rows = diagonal_.size();
  std::vector<std::size_t> of_row(rows + 1, 0);  // where the blocks of a row begin in `order`
  for (const LowerBlock& block : lower) ++of_row[block.row + 1];
  std::partial_sum(of_row.begin(), of_row.end(), of_row.begin());
  std::vector<std::size_t> order(lower.size());
  std::vector<std::size_t> next(of_row.begin(), of_row.end() - 1);
  for (std::size_t k = 0; k < lower.size(); ++k) order[next[lower[k].row]++] = k;

  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> place(rows, kNone);  // of a column in this row
  entries_.reserve(lower.size());
  begin_.reserve(rows + 1);
  for (std::size_t row = 0; row < rows; ++row) {
    begin_.push_back(entries_.size());
    for (std::size_t k = of_row[row]; k < of_row[row + 1]; ++k) {
      const auto& [_, column, value] = lower[order[k]];
      if (place[column] == kNone) {
        place[column] = entries_.size();
        entries_.push_back({column, value});
      } else {
        entries_[place[column]].value += value;
      }
    }
    for (std::size_t e = begin_.back(); e < entries_.size(); ++e) place[entries_[e].column] = kNone;
  }
  begin_.push_back(entries_.size());
}

void BlockSystem::multiply(const Vectors& x, Vectors& product) const {
  for (std::size_t row = 0; row < diagonal_.size(); ++row) {
    const Eigen::Vector3d& of_row = x[row];
    Eigen::Vector3d sum = diagonal_[row] * of_row;
    for (std::size_t e = begin_[row]; e < begin_[row + 1]; ++e) {
      const auto& [column, value] = entries_[e];
      sum += value * x[column];
      product[column] += value.transpose() * of_row;  // columns before this row: set already
    }
    product[row] = sum;
  }
}

std::optional<Vectors> BlockSystem::solve(std::span<const Eigen::Vector3d> right, int most) const {
  const std::size_t rows = diagonal_.size();
  std::vector<Eigen::Matrix3d> inverse;
  inverse.reserve(rows);
  for (const Eigen::Matrix3d& block : diagonal_) inverse.emplace_back(block.inverse());
  const auto precondition = [&](const Vectors& residual, Vectors& z) {
    for (std::size_t k = 0; k < rows; ++k) z[k] = inverse[k] * residual[k];
  };

  Vectors x(rows, Eigen::Vector3d::Zero()), residual(right.begin(), right.end()), z(x), product(x);
  precondition(residual, z);
  Vectors direction = z;
  double squared = dot(residual, z);
  const double target = kResidual * kResidual * squared;
  for (int iteration = 0; squared > target; ++iteration) {
    if (iteration == most) return std::nullopt;
    multiply(direction, product);
    const double step = squared / dot(direction, product);
    add_scaled(step, direction, x);
    add_scaled(-step, product, residual);
    precondition(residual, z);
    const double before = std::exchange(squared, dot(residual, z));
    scale_and_add(squared / before, z, direction);
  }
  if (!(squared <= target)) return std::nullopt;
  return x;
}

}  // namespace scanbench::align
