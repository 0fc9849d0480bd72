// The world that is scanned: straight walls, which are the truth, and round bodies, which are not.
#pragma once

#include <string>
#include <vector>

#include "core/geometry/geometry.hpp"
#include "core/truth.hpp"

namespace scanbench::sim {

/// A round distractor: it returns beams, but is not a line of the truth.
struct Circle {
  std::string label;
  Vec2 center = Vec2::Zero();
  double radius_m = 0.0;
};

/// A body on its own path, so that a person can walk through a scan. Kinematic: nothing stops it.
struct MovingBody {
  std::string label;
  double radius_m = 0.0;
  std::vector<Vec2> path;
  double speed_mps = 0.0;
  bool loop = false;  ///< back and forth along the path, else it stays at the end

  /// Centre at a time, by arc length along the path; at the path's start before time 0.
  Vec2 position(double time_s) const;
};

/// Metres, world frame. Wall ids are indices into walls.
struct World {
  std::string name;
  std::string about;
  std::vector<Wall> walls;
  /// Per wall the probability that a beam on it returns nothing, added to the sensor's own: black surfaces, glass (1).
  /// Empty if it is 0 for all walls.
  std::vector<double> losses;
  std::vector<Circle> circles;
  std::vector<MovingBody> moving;

  // Defined once, in world.cpp: inline they cost seconds in every unit that has one.
  World();
  World(const World&);
  World(World&&) noexcept;
  World& operator=(const World&);
  World& operator=(World&&) noexcept;
  ~World();
};

/// The largest distance of a surface from the centre of the world; ray casting is exact within it.
inline constexpr double kMaxWorldExtentM = 1e5;

/// Throws ConfigError for a world without walls, a wall or path without length, a radius or speed that is not positive,
/// a number that is not finite, a label given to two walls, a loss
/// that is not a probability, a world larger than kMaxWorldExtentM. Names the wall.
void validate(const World& world);

/// The middle of the bounding box of all surfaces; the origin for an empty world.
Vec2 center(const World& world);

}  // namespace scanbench::sim
