// The bound of many poses against numerical derivatives with one pose held, a least-squares estimator on drawn noise,
// and cases whose bound is known.
#include "metrics/joint_pose_bound.hpp"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

#include "core/rng.hpp"
#include "metrics/pose_bound.hpp"
#include "metrics/rows.hpp"
#include "tests/metrics/made_up.hpp"

namespace scanbench::test {
namespace {

using metrics::joint_pose_bound;

constexpr double kSigma = 0.01;
constexpr double kLever = 1.7;

std::vector<Wall> walls_through(const std::vector<Vec2>& corners) {
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < corners.size(); ++i)
    walls.push_back({std::to_string(i), {corners[i], corners[(i + 1) % corners.size()]}});
  return walls;
}

MadeUpRun seen_from(const std::vector<Wall>& walls, const std::vector<Pose2>& poses, int beams = 90) {
  MadeUpRun run = make_run(ScanGeometry(-kPi, kTwoPi / beams, beams), walls);
  run.observed.sensor.noise.sigma_m = kSigma;
  for (const Pose2& pose : poses) cast_frame(run, pose);
  run.result.world_from_sensor = poses;
  return run;
}

/// Three scans of a room with a corner that hides parts of it; no scan sees all walls.
MadeUpRun l_room() {
  return seen_from(walls_through({{-3, -2}, {4, -2}, {4, 2.5}, {1, 2.5}, {1, 6}, {-3, 6}}),
                   {{0.3, -0.2, 0.4}, {3, -1.1, -2.0}, {-1.4, 4.2, 1.1}});
}

/// All readings as a function of all unknowns: poses (x, y, yaw), then walls (offset, angle about the midpoint).
class Readings {
 public:
  explicit Readings(const MadeUpRun& run) : run_(run) {}

  Eigen::Index poses() const { return 3 * std::ssize(run_.truth.world_from_sensor); }
  Eigen::Index unknowns() const { return poses() + 2 * std::ssize(run_.truth.walls); }

  Pose2 pose(const Eigen::VectorXd& x, Eigen::Index k) const {
    const Pose2& p = run_.truth.world_from_sensor[as_index(k)];
    return {p.x() + x(3 * k), p.y() + x(3 * k + 1), p.yaw() + x(3 * k + 2)};
  }

  Eigen::VectorXd at(const Eigen::VectorXd& x) const {
    const ScanGeometry& geometry = run_.observed.sensor.geometry;
    Eigen::VectorXd ranges(std::ssize(run_.truth.ranges));
    for (Eigen::Index i = 0; i < ranges.size(); ++i) {
      const Pose2 sensor = pose(x, i / geometry.beams());
      const Vec2 beam = sensor.rotate(geometry.direction(static_cast<int>(i % geometry.beams())));
      const Eigen::Index wall = run_.truth.wall_ids[as_index(i)];
      const Segment& s = run_.truth.walls[as_index(wall)].segment;
      const double turn = x(poses() + 2 * wall + 1);
      const Vec2 along = Pose2(0, 0, turn).rotate(s.direction());
      const Vec2 on_wall = s.midpoint() + x(poses() + 2 * wall) * perpendicular(s.direction());
      ranges(i) = cross(on_wall - sensor.translation(), along) / cross(beam, along);
    }
    return ranges;
  }

  Eigen::MatrixXd derivative() const {
    const double h = 1e-6;
    Eigen::MatrixXd result(std::ssize(run_.truth.ranges), unknowns());
    for (Eigen::Index u = 0; u < unknowns(); ++u) {
      const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(unknowns(), u);
      result.col(u) = (at(step) - at(-step)) / (2 * h);
    }
    return result;
  }

 private:
  const MadeUpRun& run_;
};

TEST(JointPoseBound, IsThatOfNumericalDerivativesWithOnePoseHeld) {
  const MadeUpRun run = l_room();
  const Readings readings(run);
  // The first pose is held, so that the information is invertible; then the common motion is removed by an
  // orthonormal basis of it, in coordinates in which a radian is kLever metres.
  const Eigen::MatrixXd free = readings.derivative().rightCols(readings.unknowns() - 3);
  const Eigen::MatrixXd covariance = kSigma * kSigma * (free.transpose() * free).inverse();
  const Eigen::Index n = readings.poses();
  Eigen::MatrixXd poses = Eigen::MatrixXd::Zero(n, n);
  poses.bottomRightCorner(n - 3, n - 3) = covariance.topLeftCorner(n - 3, n - 3);
  Eigen::MatrixXd common(n, 3);
  Eigen::VectorXd scale(n);
  for (Eigen::Index k = 0; k < n / 3; ++k) {
    const Pose2& p = run.truth.world_from_sensor[as_index(k)];
    common.middleRows<3>(3 * k) << 1, 0, -p.y(), 0, 1, p.x(), 0, 0, kLever;
    scale.segment<3>(3 * k) << 1, 1, kLever;
  }
  const Eigen::MatrixXd basis = common.householderQr().householderQ() * Eigen::MatrixXd::Identity(n, 3);
  const Eigen::MatrixXd removal = Eigen::MatrixXd::Identity(n, n) - basis * basis.transpose();
  const Eigen::MatrixXd expected = removal * (scale.asDiagonal() * poses * scale.asDiagonal()) * removal;

  const auto bound = joint_pose_bound(run.input(), 0.1, kLever);
  ASSERT_TRUE(bound);
  EXPECT_EQ(bound->scans, (std::vector<std::size_t>{0, 1, 2}));
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double position = expected(3 * k, 3 * k) + expected(3 * k + 1, 3 * k + 1);
    const double heading = expected(3 * k + 2, 3 * k + 2) / (kLever * kLever);
    EXPECT_NEAR(bound->position[as_index(k)], position, 1e-5 * position) << k;
    EXPECT_NEAR(bound->heading[as_index(k)], heading, 1e-5 * heading) << k;
  }
}

TEST(AlignmentEfficiency, OfLeastSquaresIsOne) {
  MadeUpRun run = l_room();
  const Readings readings(run);
  const Eigen::MatrixXd derivative = readings.derivative();
  const Eigen::MatrixXd free = derivative.rightCols(readings.unknowns() - 3);
  const Eigen::LLT<Eigen::MatrixXd> normal(free.transpose() * free);
  metrics::Mean position, heading;
  for (std::uint32_t draw = 0; draw < 400; ++draw) {
    CounterRng rng(7, RngStream::range, draw);
    Eigen::VectorXd observed = readings.at(Eigen::VectorXd::Zero(readings.unknowns()));
    for (double& range : observed) range += kSigma * rng.normal();
    Eigen::VectorXd x = Eigen::VectorXd::Zero(readings.unknowns());
    for (int k = 0; k < 4; ++k) x.tail(x.size() - 3) += normal.solve(free.transpose() * (observed - readings.at(x)));
    for (Eigen::Index k = 0; k < 3; ++k) run.result.world_from_sensor[as_index(k)] = readings.pose(x, k);
    const auto rows = evaluate("alignment", run);
    position.add(row(rows, "alignment_efficiency_position").value);
    heading.add(row(rows, "alignment_efficiency_heading").value);
  }
  // Six unknowns remain: a draw scatters by about sqrt(2 / 6), the mean of 400 by 3 %.
  EXPECT_NEAR(position.value(), 1.0, 0.1);
  EXPECT_NEAR(heading.value(), 1.0, 0.1);
}

TEST(JointPoseBound, OfTwoScansAtOnePlaceIsHalfOfThatOfAKnownMap) {
  const Pose2 here(0.3, -0.2, 0.4);
  const MadeUpRun run = seen_from(walls_through({{-3, -2}, {4, -2}, {4, 2.5}, {-3, 2.5}}), {here, here});
  // Each of two equal scans has the information A about the walls, so A / 2 about the other; the common motion takes
  // half of the difference from each: (A / 2)^-1 / 4.
  const Eigen::Matrix3d known =
      metrics::pose_information(run.input(), metrics::join_walls(run.truth.walls), 0, 1).known_map.inverse();
  const auto bound = joint_pose_bound(run.input(), 0.1, kLever);
  ASSERT_TRUE(bound);
  EXPECT_NEAR(bound->position[0], 0.5 * (known(0, 0) + known(1, 1)), 1e-6 * known(0, 0));
  EXPECT_NEAR(bound->heading[1], 0.5 * known(2, 2), 1e-6 * known(2, 2));
}

TEST(JointPoseBound, LeavesOutAScanThatCanSlide) {
  MadeUpRun run = l_room();
  // A short-sighted scan outside: it sees one side of one wall, which the others see too.
  const Pose2 outside(0, -3, kPi / 2);
  cast_frame(run, outside);
  run.result.world_from_sensor.push_back(outside);
  const auto bound = joint_pose_bound(run.input(), 0.1, kLever);
  ASSERT_TRUE(bound);
  EXPECT_EQ(bound->scans, (std::vector<std::size_t>{0, 1, 2}));
  const auto rows = evaluate("alignment", run);
  EXPECT_EQ(row(rows, "alignment_determined").value, 0.75);
  EXPECT_NEAR(row(rows, "alignment_efficiency_position").value, 0.0, 1e-12) << "the poses are the true ones";
}

TEST(JointPoseBound, IsAbsentInACorridorAndForOneScan) {
  const std::vector<Wall> corridor{{"a", {{-50, -1}, {50, -1}}}, {"b", {{50, 1}, {-50, 1}}}};
  const MadeUpRun sliding = seen_from(corridor, {{0, 0, 0.5}, {0.2, 0.1, 0.6}});
  EXPECT_FALSE(joint_pose_bound(sliding.input(), 0.1, kLever));
  const auto rows = evaluate("alignment", sliding);
  EXPECT_EQ(row(rows, "alignment_efficiency").count, 0);
  EXPECT_EQ(row(rows, "alignment_determined").value, 0.0);
  EXPECT_FALSE(joint_pose_bound(seen_from(corridor, {{0, 0, 0.5}}).input(), 0.1, kLever));
}

}  // namespace
}  // namespace scanbench::test
