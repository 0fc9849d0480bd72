// Normal equations of many scans against a dense system that is assembled and solved here.
#include "algorithms/align/parts/joint_equations.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include <Eigen/Cholesky>

#include "core/rng.hpp"

namespace scanbench::align {
namespace {

/// Joins two scans by random residuals, in JointEquations and in a dense matrix.
class Both {
 public:
  explicit Both(int scans)
      : joint(static_cast<std::size_t>(scans)),
        matrix(Eigen::MatrixXd::Zero(3 * scans, 3 * scans)),
        gradient(Eigen::VectorXd::Zero(3 * scans)) {}

  /// Residuals of scan i with each of the others.
  void join(int i, const std::vector<int>& others) {
    for (const int j : others)
      for (int k = 0; k < 4; ++k) {
        const Eigen::Vector3d a = vector(), b = vector();
        const double residual = rng_.normal(), weight = 0.5 + rng_.uniform();
        joint.add(static_cast<std::size_t>(i), a, static_cast<std::size_t>(j), b, residual, weight);
        Eigen::VectorXd row = Eigen::VectorXd::Zero(gradient.size());
        row.segment<3>(3 * i) = a;
        row.segment<3>(3 * j) = b;
        matrix.triangularView<Eigen::Lower>() += weight * row * row.transpose();
        gradient += weight * residual * row;
      }
    joint.finish(static_cast<std::size_t>(i));
  }

  /// The first scan is held.
  Eigen::VectorXd dense_solution() const {
    const Eigen::Index free = gradient.size() - 3;
    Eigen::VectorXd motions = Eigen::VectorXd::Zero(gradient.size());
    motions.tail(free) =
        -matrix.bottomRightCorner(free, free).selfadjointView<Eigen::Lower>().ldlt().solve(gradient.tail(free));
    return motions;
  }

  JointEquations joint;
  Eigen::MatrixXd matrix;
  Eigen::VectorXd gradient;

 private:
  Eigen::Vector3d vector() { return {rng_.normal(), rng_.normal(), rng_.normal()}; }

  CounterRng rng_{5, RngStream::pose};
};

void expect_dense_solution(const Both& both) {
  int lowest_rank = 3;
  const std::vector<Eigen::Vector3d> motions = both.joint.solve(lowest_rank);
  EXPECT_EQ(lowest_rank, 3);
  const Eigen::VectorXd expected = both.dense_solution();
  ASSERT_EQ(motions.size() * 3, static_cast<std::size_t>(expected.size()));
  EXPECT_TRUE(motions.front().isZero(0.0));
  double worst = 0.0;
  for (std::size_t k = 0; k < motions.size(); ++k)
    worst = std::max(worst, (motions[k] - expected.segment<3>(static_cast<Eigen::Index>(3 * k))).norm());
  EXPECT_LT(worst, 1e-6 * expected.norm());  // the damping
}

TEST(JointEquations, OfManyScansThatMeetManyOthersHaveTheDenseSolution) {
  for (const int scans : {40, 230}) {  // by factorization, by conjugate gradients
    Both both(scans);
    for (int i = 0; i < scans; ++i) {
      std::vector<int> others;
      for (int step = 1; step < 30; step += 3) others.push_back((i + step) % scans);
      both.join(i, others);
    }
    expect_dense_solution(both);
  }
}

TEST(JointEquations, OfALongChainHaveTheDenseSolution) {
  constexpr int kScans = 400;
  Both both(kScans);
  for (int i = 0; i + 1 < kScans; ++i) both.join(i, {i + 1});
  both.joint.finish(kScans - 1);
  expect_dense_solution(both);
}

TEST(JointEquations, HoldAMotionThatNoResidualOfAScanDetermines) {
  constexpr int kScans = 210;
  JointEquations joint(kScans);
  for (std::size_t i = 1; i < kScans; ++i) {  // all on scan 0; the odd ones only across and in rotation
    if (i % 2 == 0) joint.add(i, {1, 0, 0}, 0, {-1, 0, 0}, 0.5, 1.0);
    joint.add(i, {0, 1, 0}, 0, {0, -1, 0}, 0.25, 2.0);
    joint.add(i, {0, 0, 1}, 0, {0, 0, -1}, -0.125, 4.0);
    joint.finish(i);
  }
  int lowest_rank = 3;
  const std::vector<Eigen::Vector3d> motions = joint.solve(lowest_rank);
  EXPECT_EQ(lowest_rank, 2);
  for (std::size_t k = 1; k < kScans; ++k)
    EXPECT_LT((motions[k] - Eigen::Vector3d(k % 2 == 0 ? -0.5 : 0.0, -0.25, 0.125)).norm(), 1e-6) << "scan " << k;
}

}  // namespace
}  // namespace scanbench::align
