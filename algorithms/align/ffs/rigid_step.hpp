// Newton's law for scans as rigid bodies (Lakaemper 2010, section 3).
#pragma once

#include <span>
#include <vector>

#include "algorithms/align/ffs/body.hpp"
#include "algorithms/align/ffs/force_field.hpp"

namespace scanbench::align::ffs {

/// The motion of a body: acceleration of its centre [per unit mass], angular acceleration about it, and the stiffness
/// of the springs that hold it, per unit mass and per unit inertia.
struct Drive {
  Vec2 acceleration = Vec2::Zero();
  double angular = 0.0;
  double stiffness = 0.0;
};

/// Sums of the forces on the points of each body. The points of each body are consecutive, and the bodies are in order
/// from place 0. A body without extent does not rotate.
std::vector<Drive> drives_of(std::span<const Body> bodies, std::span<const Pose2> poses, const FieldPoints& points,
                             std::span<const PointForce> forces);

/// The largest dt^2 / 2 with which no body passes the balance of its springs. `least_stiffness` > 0 bounds it where all
/// springs are faint: bodies that hardly hold each other are not thrown. 0 if nothing is driven and it is 0.
double largest_step(std::span<const Drive> drives, double least_stiffness = 0.0);

/// Moves all bodies at once from rest, by acceleration * dt^2 / 2 and a rotation about the centre by angular * dt^2 /
/// 2. If a point would move by more than `limit`, all motions are scaled down together. Returns the largest
/// displacement.
double move(std::span<const Body> bodies, std::span<const Drive> drives, double half_dt_squared, double limit,
            std::vector<Pose2>& poses);

}  // namespace scanbench::align::ffs
