// Gradient check of both phases on the spiral (Lakaemper 2009, figure 2), by brute force in double from the merger's
// trace: modes are modes of the density that the paper's kernels define, and the density never falls along a climb.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/contracts/mean_shift_trace.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"
#include "tests/support/spiral.hpp"
#include "tests/support/trace_recorder.hpp"

namespace scanbench {
namespace {

using Vec3 = Eigen::Vector3d;

constexpr double kSigma = 0.20;
constexpr double kAngleScale = radians(10.0);  // 20 cm relate to 10 degrees (eq. 4)

/// From the first place to the second, in standard deviations of a phase's kernel.
using Metric = std::function<Vec3(const Vec3&, const Vec3&)>;

Vec3 metric1(const Vec3& from, const Vec3& to) {  // eqs 3 and 4
  return {(to.x() - from.x()) / kSigma, (to.y() - from.y()) / kSigma,
          std::remainder(to.z() - from.z(), kPi) / kAngleScale};
}

Metric metric2(double theta) {  // eq. 5 in the cluster's frame: 2 sigma along, sigma / 10 across
  return [=](const Vec3& from, const Vec3& to) -> Vec3 {
    const Vec2 d = (to - from).head<2>();
    const Vec2 along(std::cos(theta), std::sin(theta));
    return {along.dot(d) / (2 * kSigma), cross(along, d) / (kSigma / 10), 0.0};
  };
}

double density(const std::vector<Vec3>& points, const Vec3& at, const Metric& metric) {
  double sum = 0.0;
  for (const Vec3& p : points) sum += std::exp(-0.5 * metric(at, p).squaredNorm());
  return sum;
}

/// The gradient over the density, in standard deviations.
double relative_gradient(const std::vector<Vec3>& points, const Vec3& at, const Metric& metric) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) {
    const Vec3 d = metric(at, p);
    sum += std::exp(-0.5 * d.squaredNorm()) * d;
  }
  return sum.norm() / density(points, at, metric);
}

/// The spiral merged with kernels that are cut where they have fallen to 2e-8.
struct Climbs {
  Climbs() {
    Registry<SegmentMerger>::make("mean_shift", {{"sigma_m", kSigma}, {"cutoff", 6.0}})
        ->merge({support::spiral(), {}}, recorder.trace);
    for (const auto& row : recorder.rows<mean_shift::JointSpaceRow>())
      points.emplace_back(row.x_m, row.y_m, row.alpha_rad);
  }
  template <int kPhase>
  std::vector<std::vector<Vec3>> paths() const {
    std::vector<std::vector<Vec3>> result(points.size());
    for (const auto& row : recorder.rows<mean_shift::TrajectoryRow<kPhase>>())
      result[static_cast<std::size_t>(row.piece)].emplace_back(row.x_m, row.y_m, row.alpha_rad);
    return result;
  }
  support::TraceRecorder recorder{"merge"};
  std::vector<Vec3> points;
};

void expect_a_climb_to_a_mode(const std::vector<Vec3>& path, const std::vector<Vec3>& points, const Metric& metric) {
  ASSERT_GE(path.size(), 1U);
  for (std::size_t k = 1; k < path.size(); ++k)
    EXPECT_GE(density(points, path[k], metric), density(points, path[k - 1], metric) * (1 - 1e-6)) << "step " << k;
  EXPECT_LT(relative_gradient(points, path.back(), metric), 1e-6);
}

TEST(MeanShiftGradient, IsZeroAtTheEndOfEveryClimbOfPhase1AndTheDensityNeverFalls) {
  Climbs climbs;
  for (const auto& path : climbs.paths<1>()) expect_a_climb_to_a_mode(path, climbs.points, metric1);
}

TEST(MeanShiftGradient, IsZeroAtTheEndOfEveryClimbOfPhase2AndTheDensityNeverFalls) {
  Climbs climbs;
  const auto paths = climbs.paths<2>();
  std::map<int, std::vector<std::size_t>> clusters;
  for (const auto& row : climbs.recorder.rows<mean_shift::ClusterRow>())
    clusters[row.cluster1].push_back(static_cast<std::size_t>(row.piece));
  ASSERT_GT(clusters.size(), 5U);
  for (const auto& [cluster, members] : clusters) {
    std::vector<Vec3> points;
    for (const std::size_t k : members) points.push_back(climbs.points[k]);
    for (const std::size_t k : members) expect_a_climb_to_a_mode(paths[k], points, metric2(paths[k].back().z()));
  }
}

}  // namespace
}  // namespace scanbench
