// Checks a world, and computes the positions of its moving bodies.
#include "sim/world.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "sim/label_set.hpp"
#include "sim/path.hpp"
#include "sim/place_text.hpp"

namespace scanbench::sim {
namespace {

void check_finite(const Vec2& p, const std::string& what) {
  if (!p.allFinite()) throw ConfigError(what + " has a coordinate that is not a finite number");
}

void check_positive(double value, const std::string& what, const std::string& quantity) {
  if (!(value > 0) || !std::isfinite(value))
    throw ConfigError(what + " has " + quantity + " " + number_text(value) + "; allowed: finite and > 0");
}

struct Box {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high = Vec2::Constant(-std::numeric_limits<double>::infinity());

  void add(const Vec2& p, double margin = 0.0) {
    low = low.cwiseMin(p - Vec2::Constant(margin));
    high = high.cwiseMax(p + Vec2::Constant(margin));
  }
};

Box bounding_box(const World& world) {
  Box box;
  for (const Wall& wall : world.walls) {
    box.add(wall.segment.a);
    box.add(wall.segment.b);
  }
  for (const Circle& circle : world.circles) box.add(circle.center, circle.radius_m);
  for (const MovingBody& body : world.moving)
    for (const Vec2& p : body.path) box.add(p, body.radius_m);
  return box;
}

}  // namespace

World::World() = default;
World::World(const World&) = default;
World::World(World&&) noexcept = default;
World& World::operator=(const World&) = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

Vec2 MovingBody::position(double time_s) const {
  if (path.empty()) return Vec2::Zero();
  double arc = std::max(time_s, 0.0) * speed_mps;
  if (loop) {
    const double length = path_length(path);
    if (length > 0) {
      arc = std::fmod(arc, 2.0 * length);
      if (arc > length) arc = 2.0 * length - arc;
    }
  }
  return point_on_path(path, arc).position;
}

Vec2 center(const World& world) {
  const Box box = bounding_box(world);
  if (!(box.low.x() <= box.high.x())) return Vec2::Zero();
  return 0.5 * (box.low + box.high);
}

void validate(const World& world) {
  if (world.walls.empty()) throw ConfigError("the world '" + world.name + "' has no walls; it needs at least one");
  if (!world.losses.empty() && world.losses.size() != world.walls.size())
    throw ConfigError("the world '" + world.name + "' has losses of " + std::to_string(world.losses.size()) +
                      " walls; it needs one for each of its " + std::to_string(world.walls.size()) + " walls, or none");
  for (std::size_t i = 0; i < world.losses.size(); ++i)
    if (!(world.losses[i] >= 0 && world.losses[i] <= 1))
      throw ConfigError("wall '" + world.walls[i].label + "' has a loss of " + number_text(world.losses[i]) +
                        "; allowed: a probability, 0 .. 1");
  LabelSet labels(world.walls.size());
  for (std::size_t i = 0; i < world.walls.size(); ++i) {
    const Wall& wall = world.walls[i];
    const auto what = [&] { return "wall '" + wall.label + "' (number " + std::to_string(i + 1) + ")"; };
    if (!wall.segment.a.allFinite() || !wall.segment.b.allFinite())
      throw ConfigError(what() + " has a coordinate that is not a finite number");
    if (wall.segment.a == wall.segment.b)
      throw ConfigError(what() + " has no length: both ends are at " + place_text(wall.segment.a));
    if (!wall.label.empty() && !labels.insert(wall.label))
      throw ConfigError(what() + " has the label of another wall; metrics name walls by their labels");
  }
  for (const Circle& circle : world.circles) {
    const std::string what = "circle '" + circle.label + "'";
    check_finite(circle.center, what);
    check_positive(circle.radius_m, what, "radius_m");
  }
  for (const MovingBody& body : world.moving) {
    const std::string what = "moving body '" + body.label + "'";
    for (const Vec2& p : body.path) check_finite(p, what);
    check_positive(body.radius_m, what, "radius_m");
    check_positive(body.speed_mps, what, "speed_mps");
    if (!(path_length(body.path) > 0))
      throw ConfigError(what + " has a path without length; it needs at least two different points");
  }
  const Box box = bounding_box(world);
  const double extent = 0.5 * (box.high - box.low).norm();
  if (!(extent <= kMaxWorldExtentM))
    throw ConfigError("the world '" + world.name + "' reaches " + number_text(extent) +
                      " m from its centre; allowed: up to " + number_text(kMaxWorldExtentM) + " m");
}

}  // namespace scanbench::sim
