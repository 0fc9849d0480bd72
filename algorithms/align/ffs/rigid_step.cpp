// Forces and torques of bodies, and the largest step that the forces allow.
#include "algorithms/align/ffs/rigid_step.hpp"

#include <algorithm>
#include <cmath>

namespace scanbench::align::ffs {

std::vector<Drive> drives_of(std::span<const Body> bodies, std::span<const Pose2> poses, const FieldPoints& points,
                             std::span<const PointForce> forces) {
  std::vector<Drive> drives(bodies.size());
  std::size_t first = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Body& body = bodies[b];
    if (body.points.empty()) continue;
    const Vec2 centre = poses[b] * body.centre;
    Vec2 force = Vec2::Zero();
    double torque = 0.0, springs = 0.0, turning_springs = 0.0;
    for (std::size_t k = first; k < first + body.points.size(); ++k) {
      const Vec2 arm = points.at[k] - centre;
      force += forces[k].force;
      torque += cross(arm, forces[k].force);
      springs += forces[k].stiffness;
      turning_springs += arm.squaredNorm() * forces[k].stiffness;
    }
    first += body.points.size();
    drives[b].acceleration = force / body.mass();
    drives[b].stiffness = springs / body.mass();
    if (!(body.inertia > 0)) continue;
    drives[b].angular = torque / body.inertia;
    drives[b].stiffness = std::max(drives[b].stiffness, turning_springs / body.inertia);
  }
  return drives;
}

double largest_step(std::span<const Drive> drives, double least_stiffness) {
  double stiffest = least_stiffness;
  for (const Drive& drive : drives) stiffest = std::max(stiffest, drive.stiffness);
  return stiffest > 0 ? 1.0 / stiffest : 0.0;
}

double move(std::span<const Body> bodies, std::span<const Drive> drives, double half_dt_squared, double limit,
            std::vector<Pose2>& poses) {
  double largest = 0.0;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    largest = std::max(largest, drives[b].acceleration.norm() + std::abs(drives[b].angular) * bodies[b].radius);
  largest *= half_dt_squared;
  const double k = largest > limit ? half_dt_squared * limit / largest : half_dt_squared;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Vec2 centre = poses[b] * bodies[b].centre;
    const Pose2 turn(Vec2::Zero(), k * drives[b].angular);
    const Vec2 heading = (turn * Pose2::from_unit(Vec2::Zero(), {poses[b].cos(), poses[b].sin()})).rotate({1.0, 0.0});
    const Vec2 offset = turn.rotate(poses[b].translation() - centre);
    poses[b] = Pose2::from_unit(centre + k * drives[b].acceleration + offset, heading);
  }
  return std::min(largest, limit);
}

}  // namespace scanbench::align::ffs
