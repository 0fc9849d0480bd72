// Conjugate gradients on 3 x 3 blocks against a dense factorization.
#include "algorithms/align/parts/block_system.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include <Eigen/Cholesky>

#include "core/rng.hpp"

namespace scanbench::align {
namespace {

struct Example {
  std::vector<Eigen::Matrix3d> diagonal;
  std::vector<LowerBlock> lower;
  std::vector<Eigen::Vector3d> right;
  Eigen::MatrixXd dense;
  Eigen::VectorXd dense_right;
};

/// A positive definite matrix: J^T J of random rows that join two scans each, and a little on the diagonal. Each pair
/// of scans contributes several blocks at one place, in no order.
Example example(int scans, int rows, std::uint64_t seed) {
  Example e;
  const auto n = static_cast<std::size_t>(scans);
  e.diagonal.assign(n, 0.01 * Eigen::Matrix3d::Identity());
  e.dense = 0.01 * Eigen::MatrixXd::Identity(3 * scans, 3 * scans);
  e.dense_right.resize(3 * scans);
  CounterRng rng(seed, RngStream::pose);
  const auto vector = [&] { return Eigen::Vector3d(rng.normal(), rng.normal(), rng.normal()); };
  for (int k = 0; k < rows; ++k) {
    const auto first = static_cast<int>(rng.uniform() * scans), second = static_cast<int>(rng.uniform() * scans);
    if (first == second) continue;
    const auto i = static_cast<std::size_t>(std::max(first, second)),
               j = static_cast<std::size_t>(std::min(first, second));
    const Eigen::Vector3d a = vector(), b = vector();
    e.diagonal[i] += a * a.transpose();
    e.diagonal[j] += b * b.transpose();
    e.lower.push_back({i, j, a * b.transpose()});
    Eigen::VectorXd row = Eigen::VectorXd::Zero(3 * scans);
    row.segment<3>(static_cast<Eigen::Index>(3 * i)) = a;
    row.segment<3>(static_cast<Eigen::Index>(3 * j)) = b;
    e.dense += row * row.transpose();
  }
  for (int k = 0; k < scans; ++k) {
    e.right.push_back(vector());
    e.dense_right.segment<3>(3 * k) = e.right.back();
  }
  return e;
}

TEST(BlockSystem, AgreesWithADenseFactorization) {
  for (const int rows : {0, 30, 300, 3000}) {
    const Example e = example(20, rows, 7);
    const auto solution = BlockSystem(e.diagonal, e.lower).solve(e.right, 1000);
    ASSERT_TRUE(solution.has_value()) << rows;
    const Eigen::VectorXd expected = e.dense.ldlt().solve(e.dense_right);
    for (std::size_t k = 0; k < solution->size(); ++k)
      EXPECT_LT(((*solution)[k] - expected.segment<3>(static_cast<Eigen::Index>(3 * k))).norm(), 1e-8 * expected.norm())
          << rows << " rows, block " << k;
  }
}

TEST(BlockSystem, WithoutBlocksBelowTheDiagonalNeedsOneIteration) {
  const Example e = example(20, 0, 7);
  const auto solution = BlockSystem(e.diagonal, {}).solve(e.right, 1);
  ASSERT_TRUE(solution.has_value());
  for (std::size_t k = 0; k < e.right.size(); ++k) EXPECT_LT(((*solution)[k] - 100.0 * e.right[k]).norm(), 1e-10);
}

TEST(BlockSystem, OfAZeroRightSideIsZeroWithoutAnIteration) {
  const Example e = example(5, 40, 3);
  const auto solution = BlockSystem(e.diagonal, e.lower).solve(std::vector(5, Eigen::Vector3d(0, 0, 0)), 0);
  ASSERT_TRUE(solution.has_value());
  for (const Eigen::Vector3d& x : *solution) EXPECT_TRUE(x.isZero(0.0));
}

TEST(BlockSystem, SaysThatItDidNotFinish) {
  Example e = example(20, 300, 7);
  EXPECT_FALSE(BlockSystem(e.diagonal, e.lower).solve(e.right, 3).has_value());
  e.right[4].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(BlockSystem(e.diagonal, e.lower).solve(e.right, 1000).has_value());
}

}  // namespace
}  // namespace scanbench::align
