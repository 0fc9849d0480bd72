// Gauss-Newton on the readings of two scans; the places of the surfaces are eliminated (Schur complement).
#include "bench/accuracy/pose_oracle.hpp"

#include <cmath>
#include <map>
#include <vector>

#include <Eigen/LU>

#include "core/index.hpp"

namespace scanbench::accuracy {
namespace {

constexpr double kLeastCosine = 1e-3;  // of a beam with the normal; below, the estimate has turned the wall away

struct Reading {
  Vec2 direction = Vec2::Zero();  ///< in its own scan
  double range = 0.0;
  double sigma = 0.0;
};

/// A surface in the frame of the reference, with what each scan reads on it.
struct Seen {
  Vec2 point = Vec2::Zero();
  Vec2 normal = Vec2::Zero();  ///< away from the sensors
  std::vector<Reading> before, now;
};

std::vector<Reading> readings_on(const metrics::MetricInput& input, const metrics::Surfaces& surfaces,
                                 std::size_t frame, int surface) {
  std::vector<Reading> result;
  const Scan scan = input.observed.scan(frame);
  const std::size_t first = frame * as_index(scan.beams());
  for (int i = 0; i < scan.beams(); ++i) {
    const int wall = input.truth->wall_ids[first + as_index(i)];
    if (wall < 0 || !scan.valid(i) || surfaces.of_wall[as_index(wall)] != surface) continue;
    result.push_back({scan.sensor.geometry.direction(i), scan.ranges[as_index(i)],
                      scan.sensor.noise.range_sigma(input.truth->ranges[first + as_index(i)])});
  }
  return result;
}

std::vector<Seen> seen_by_both(const metrics::MetricInput& input, const metrics::Surfaces& surfaces,
                               std::size_t reference, std::size_t frame, int least_returns) {
  std::vector<Seen> result;
  const Pose2 from_world = input.truth->world_from_sensor[reference].inverse();
  for (std::size_t s = 0; s < surfaces.segments.size(); ++s) {
    Seen seen;
    seen.before = readings_on(input, surfaces, reference, static_cast<int>(s));
    if (std::ssize(seen.before) < least_returns || seen.before.empty()) continue;
    seen.now = readings_on(input, surfaces, frame, static_cast<int>(s));
    if (std::ssize(seen.now) < least_returns || seen.now.empty()) continue;
    const Segment& wall = surfaces.segments[s];
    seen.normal = from_world.rotate(perpendicular(wall.direction()));
    for (const Reading& r : seen.before) seen.point += r.range * r.direction / static_cast<double>(seen.before.size());
    const Vec2 corner = from_world * wall.a;
    seen.point -= seen.normal.dot(seen.point - corner) * seen.normal;
    if (seen.normal.dot(seen.point) < 0) seen.normal = -seen.normal;
    result.push_back(std::move(seen));
  }
  return result;
}

/// Normal equations of one surface: pose (3), place (2), and what couples them.
struct Block {
  Eigen::Matrix3d pose = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> coupling = Eigen::Matrix<double, 3, 2>::Zero();
  Eigen::Matrix2d place = Eigen::Matrix2d::Zero();
  Eigen::Vector3d pose_rhs = Eigen::Vector3d::Zero();
  Eigen::Vector2d place_rhs = Eigen::Vector2d::Zero();
};

/// Adds one reading; false if its beam cannot see the surface. A beam from o in direction d reads
/// r = n.(p - o) / n.d; offset, angle, shift and turn change it by 1, n'.(p - o) - r n'.d, -n and -r n.d' over n.d.
bool add(const Reading& reading, const Seen& seen, const Pose2& pose, bool moves, Block& block, double& cost) {
  const Vec2 d = pose.rotate(reading.direction), arm = seen.point - pose.translation();
  const double cosine = seen.normal.dot(d);
  if (!(cosine > kLeastCosine)) return false;
  const double range = seen.normal.dot(arm) / cosine;
  const Vec2 turned = perpendicular(seen.normal);
  const Eigen::Vector2d by_place(1.0 / cosine, (turned.dot(arm) - range * turned.dot(d)) / cosine);
  Eigen::Vector3d by_pose = Eigen::Vector3d::Zero();
  if (moves) by_pose << -seen.normal / cosine, -range * seen.normal.dot(perpendicular(d)) / cosine;
  const double weight = 1.0 / (reading.sigma * reading.sigma), residual = reading.range - range;
  block.pose += weight * by_pose * by_pose.transpose();
  block.coupling += weight * by_pose * by_place.transpose();
  block.place += weight * by_place * by_place.transpose();
  block.pose_rhs += weight * residual * by_pose;
  block.place_rhs += weight * residual * by_place;
  cost += 0.5 * weight * residual * residual;
  return true;
}

/// The equations of all surfaces at one estimate; cost is infinite where a beam cannot see its surface.
struct Linearised {
  std::vector<Block> blocks;
  double cost = 0.0;
};

Linearised linearised(const std::vector<Seen>& surfaces, const Pose2& pose) {
  Linearised result;
  for (const Seen& seen : surfaces) {
    Block& block = result.blocks.emplace_back();
    bool possible = true;
    for (const Reading& r : seen.before) possible &= add(r, seen, Pose2(), false, block, result.cost);
    for (const Reading& r : seen.now) possible &= add(r, seen, pose, true, block, result.cost);
    if (!possible) result.cost = INFINITY;
  }
  return result;
}

bool determines_place(const Block& block) {
  return block.place.determinant() > 1e-12 * block.place(0, 0) * block.place(1, 1);
}

}  // namespace

std::optional<Match> oracle_match(const metrics::MetricInput& input, const metrics::Surfaces& surfaces,
                                  std::size_t reference, std::size_t frame, int least_returns) {
  const auto& poses = input.truth->world_from_sensor;
  Pose2 pose = poses[reference].inverse() * poses[frame];
  std::vector<Seen> seen = seen_by_both(input, surfaces, reference, frame, least_returns);
  Linearised now = linearised(seen, pose);
  Match match;
  for (int round = 0; round < 30; ++round) {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Vector3d rhs = Eigen::Vector3d::Zero();
    for (const Block& b : now.blocks) {
      if (!determines_place(b)) continue;
      const Eigen::Matrix<double, 3, 2> gain = b.coupling * b.place.inverse();
      information += b.pose - gain * b.coupling.transpose();
      rhs += b.pose_rhs - gain * b.place_rhs;
    }
    if (!(information.determinant() > 0)) return std::nullopt;
    match.covariance = information.inverse();
    const Eigen::Vector3d step = match.covariance * rhs;
    bool better = false;
    for (double scale = 1.0; scale > 1e-3 && !better; scale *= 0.5) {
      const Pose2 tried(pose.translation() + scale * step.head<2>(), pose.yaw() + scale * step.z());
      std::vector<Seen> walls = seen;
      for (std::size_t k = 0; k < walls.size(); ++k) {
        const Block& b = now.blocks[k];
        if (!determines_place(b)) continue;
        const Eigen::Vector2d change = scale * b.place.inverse() * (b.place_rhs - b.coupling.transpose() * step);
        walls[k].point += change[0] * walls[k].normal;
        walls[k].normal = Pose2(0, 0, change[1]).rotate(walls[k].normal);
      }
      Linearised next = linearised(walls, tried);
      better = next.cost <= now.cost;
      if (!better) continue;
      pose = tried;
      seen = std::move(walls);
      now = std::move(next);
    }
    if (!better || step.norm() < 1e-9) break;
  }
  match.reference_from_current = pose;
  return match;
}

}  // namespace scanbench::accuracy
