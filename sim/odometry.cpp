// Computes odometry: a random walk along the path, then an independent error per pose.
#include "sim/odometry.hpp"

#include <cmath>
#include <cstddef>

#include "core/geometry/geometry.hpp"
#include "core/rng.hpp"

namespace scanbench::sim {

std::vector<Pose2> odometry_poses(std::span<const Pose2> world_from_sensor, const OdometryNoise& noise,
                                  std::uint64_t seed) {
  const bool drifts = noise.translation_per_m > 0 || noise.rotation_per_m_rad > 0 || noise.rotation_per_rad > 0;
  const bool jitters = noise.pose_position_sigma_m > 0 || noise.pose_heading_sigma_rad > 0;
  std::vector<Pose2> odometry(world_from_sensor.begin(), world_from_sensor.end());
  Pose2 drifted = odometry.empty() ? Pose2() : odometry.front();
  for (std::size_t k = 1; k < odometry.size(); ++k) {
    const auto frame = static_cast<std::uint32_t>(k);
    if (drifts) {
      const Pose2 step = world_from_sensor[k - 1].inverse() * world_from_sensor[k];
      const double way = step.translation().norm();
      const double turn = std::fabs(step.yaw());
      CounterRng rng(seed, RngStream::odometry, frame);
      const double along = noise.translation_per_m * std::sqrt(way) * rng.normal();
      const double rotation = std::sqrt(noise.rotation_per_m_rad * noise.rotation_per_m_rad * way +
                                        noise.rotation_per_rad * noise.rotation_per_rad * turn) *
                              rng.normal();
      const Vec2 translation = way > 0 ? Vec2((1.0 + along / way) * step.translation()) : step.translation();
      drifted = drifted * Pose2(translation, 0.0) * Pose2::facing(Vec2::Zero(), {step.cos(), step.sin()}) *
                Pose2(0.0, 0.0, rotation);
      odometry[k] = drifted;
    }
    if (jitters) {
      CounterRng rng(seed, RngStream::pose, frame);
      const double dx = noise.pose_position_sigma_m * rng.normal();
      const double dy = noise.pose_position_sigma_m * rng.normal();
      const double turn = noise.pose_heading_sigma_rad * rng.normal();
      const Pose2& pose = odometry[k];
      const Vec2 heading = Pose2(0.0, 0.0, turn).rotate({pose.cos(), pose.sin()});
      odometry[k] = Pose2::facing(pose.translation() + Vec2(dx, dy), heading);
    }
  }
  return odometry;
}

}  // namespace scanbench::sim
