// Interpolates the motion between poses, and checks that the path is clear.
#include "sim/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/segment_grid.hpp"
#include "core/number_text.hpp"
#include "sim/place_text.hpp"

namespace scanbench::sim {
namespace {

// A sensor closer to a wall than this is on it.
constexpr double kOnWallM = 1e-3;
static_assert(kOnWallM < SegmentGrid::kMarginM);

std::string pose_text(const Trajectory& trajectory, std::size_t frame) {
  return "scan " + std::to_string(frame) + ": the sensor at " +
         place_text(trajectory.poses[frame].world_from_sensor.translation());
}

// Point where the path from p to q crosses a wall, its ends included; for a path along the wall the first common point.
std::optional<Vec2> crossing(const Vec2& p, const Vec2& q, const Segment& wall) {
  const Vec2 step = q - p;
  const Vec2 along = wall.b - wall.a;
  const double side_a = cross(step, Vec2(wall.a - p));
  const double side_b = cross(step, Vec2(wall.b - p));
  const double side_p = cross(along, Vec2(p - wall.a));
  const double side_q = cross(along, Vec2(q - wall.a));
  if (side_a * side_b > 0 || side_p * side_q > 0) return std::nullopt;
  if (side_p != side_q) return Vec2(p + (side_p / (side_p - side_q)) * step);
  // Path and wall are on one line.
  const double n2 = step.squaredNorm();
  if (n2 == 0) return std::nullopt;
  const double ta = step.dot(wall.a - p) / n2;
  const double tb = step.dot(wall.b - p) / n2;
  if (std::max(ta, tb) < 0 || std::min(ta, tb) > 1) return std::nullopt;
  return Vec2(p + std::clamp(std::min(ta, tb), 0.0, 1.0) * step);
}

void check_step(const World& world, const SegmentGrid& grid, const Vec2& p, const Vec2& q) {
  std::size_t first = world.walls.size();
  grid.for_each_near({p, q}, [&](std::size_t i) {
    if (i < first && crossing(p, q, world.walls[i].segment)) first = i;
  });
  if (first < world.walls.size()) {
    const Wall& wall = world.walls[first];
    throw ConfigError("the path from " + place_text(p) + " to " + place_text(q) + " crosses wall '" + wall.label +
                      "' at " + place_text(*crossing(p, q, wall.segment)) + "; paths must keep clear of walls");
  }
  for (const Circle& circle : world.circles)
    if (distance(circle.center, Segment{p, q}) < circle.radius_m)
      throw ConfigError("the path from " + place_text(p) + " to " + place_text(q) + " runs through circle '" +
                        circle.label + "', radius " + metres_text(circle.radius_m) + " m about " +
                        place_text(circle.center) + "; paths must keep clear of round bodies");
}

void check_body(const std::string& who, const Vec2& p, const std::string& body, const Vec2& body_center,
                double radius) {
  if ((p - body_center).norm() <= radius)
    throw ConfigError(who + " is inside " + body + ", radius " + metres_text(radius) + " m about " +
                      place_text(body_center));
}

[[noreturn]] void refuse_far_away(const World& world, const TimedPose& pose, const std::string& who,
                                  double range_max_m) {
  const Vec2& p = pose.world_from_sensor.translation();
  double nearest = std::numeric_limits<double>::infinity();
  std::string name = "nothing";
  const auto consider = [&](double d, const char* kind, const std::string& label) {
    if (d >= nearest) return;
    nearest = d;
    name = std::string(kind) + " '" + label + "'";
  };
  for (const Wall& wall : world.walls) consider(distance(p, wall.segment), "wall", wall.label);
  for (const Circle& circle : world.circles)
    consider((p - circle.center).norm() - circle.radius_m, "circle", circle.label);
  for (const MovingBody& body : world.moving)
    consider((p - body.position(pose.stamp_s)).norm() - body.radius_m, "moving body", body.label);
  throw ConfigError(who + " is outside any free space: the nearest surface, " + name + ", is " + metres_text(nearest) +
                    " m away, and the sensor's range is " + number_text(range_max_m) + " m");
}

void check_pose(const World& world, const SegmentGrid& grid, const Trajectory& trajectory, std::size_t frame,
                double range_max_m) {
  const TimedPose& pose = trajectory.poses[frame];
  const Vec2& p = pose.world_from_sensor.translation();
  if (!p.allFinite() || !std::isfinite(pose.world_from_sensor.cos()) || !std::isfinite(pose.world_from_sensor.sin()) ||
      !std::isfinite(pose.stamp_s))
    throw ConfigError("scan " + std::to_string(frame) + ": the pose or its time is not a finite number");
  const std::string who = pose_text(trajectory, frame);
  std::size_t first = world.walls.size();
  grid.for_each_near({p, p}, [&](std::size_t i) {
    if (i < first && distance(p, world.walls[i].segment) < kOnWallM) first = i;
  });
  if (first < world.walls.size())
    throw ConfigError(who + " is on wall '" + world.walls[first].label + "' (" +
                      number_text(distance(p, world.walls[first].segment)) + " m from it; allowed: at least " +
                      number_text(kOnWallM) + " m)");
  bool in_range = std::isinf(range_max_m);
  for (const Circle& circle : world.circles) {
    check_body(who, p, "circle '" + circle.label + "'", circle.center, circle.radius_m);
    in_range = in_range || (p - circle.center).norm() - circle.radius_m <= range_max_m;
  }
  for (const MovingBody& body : world.moving) {
    const Vec2 at = body.position(pose.stamp_s);
    check_body(who, p, "moving body '" + body.label + "' at " + number_text(pose.stamp_s) + " s", at, body.radius_m);
    in_range = in_range || (p - at).norm() - body.radius_m <= range_max_m;
  }
  if (!in_range && grid.distance(p) > range_max_m) refuse_far_away(world, pose, who, range_max_m);
}

}  // namespace

Pose2 pose_during_scan(const Trajectory& trajectory, std::size_t frame, double time_s) {
  const auto& poses = trajectory.poses;
  SCANBENCH_ASSERT(frame < poses.size());
  const Pose2& pose = poses[frame].world_from_sensor;
  if (!trajectory.continuous || trajectory.stops || poses.size() < 2 || time_s == 0) return pose;
  const std::size_t from = std::min(frame, poses.size() - 2);
  const double period = poses[from + 1].stamp_s - poses[from].stamp_s;
  SCANBENCH_ASSERT(period > 0);
  const Eigen::Vector3d twist = (poses[from].world_from_sensor.inverse() * poses[from + 1].world_from_sensor).log();
  return pose * Pose2::exp((time_s / period) * twist);
}

void check_clear(const World& world, const Trajectory& trajectory, double range_max_m) {
  std::vector<Segment> walls;
  for (const Wall& wall : world.walls) walls.push_back(wall.segment);
  const SegmentGrid grid(walls);
  for (std::size_t frame = 0; frame < trajectory.poses.size(); ++frame) {
    check_pose(world, grid, trajectory, frame, range_max_m);
    if (frame > 0 && !(trajectory.poses[frame].stamp_s > trajectory.poses[frame - 1].stamp_s))
      throw ConfigError("scan " + std::to_string(frame) + ": its time is not after that of the scan before it");
  }
  if (!trajectory.continuous) return;
  if (!trajectory.path.empty()) {
    for (std::size_t i = 1; i < trajectory.path.size(); ++i)
      check_step(world, grid, trajectory.path[i - 1], trajectory.path[i]);
    return;
  }
  for (std::size_t k = 1; k < trajectory.poses.size(); ++k)
    check_step(world, grid, trajectory.poses[k - 1].world_from_sensor.translation(),
               trajectory.poses[k].world_from_sensor.translation());
}

}  // namespace scanbench::sim
