// Detection of rectangles: parallel pairs of segments, pairs of these pairs, and the ideal rectangle of each.
#include "algorithms/align/ffs/rectangles.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/portable_math.hpp"

namespace scanbench::align::ffs {
namespace {

/// S, L of a segment; D is computed in the frame of the pair or rectangle.
struct Side {
  Vec2 middle;
  Vec2 along;  ///< unit, undirected
  double length;
  Segment segment;
};

struct Pair {
  std::size_t a, b;
  Vec2 along;         ///< unit, undirected
  double extent;      ///< extent of both sides' projections on their common direction
  double separation;  ///< distance of their midpoints across that direction
  Vec2 centre;
};

/// The square of a complex number; it doubles the angle of a unit vector.
Vec2 squared(const Vec2& z) {
  return {z.x() * z.x() - z.y() * z.y(), 2.0 * z.x() * z.y()};
}

std::pair<double, double> ordered(double a, double b) {
  return {std::min(a, b), std::max(a, b)};
}

std::vector<Side> sides_of(std::span<const Segment> segments) {
  std::vector<Side> sides;
  for (const Segment& s : segments)
    if (s.length() > 0) sides.push_back({s.midpoint(), s.direction(), s.length(), s});
  // Sorts the sides, so that the result does not depend on their given order.
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    if (a.length != b.length) return a.length > b.length;
    return a.middle.x() != b.middle.x() ? a.middle.x() < b.middle.x() : a.middle.y() < b.middle.y();
  });
  return sides;
}

std::vector<Pair> parallel_pairs(const std::vector<Side>& sides, const RectangleRules& rules) {
  std::vector<Pair> pairs;
  const double sine = portable::sincos(rules.angle_rad).sin;
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (std::size_t j = i + 1; j < sides.size(); ++j) {
      const Side &a = sides[i], &b = sides[j];  // a is the longer
      if (b.length < rules.min_length_ratio * a.length) break;
      if (std::fabs(cross(a.along, b.along)) > sine) continue;
      const double sign = a.along.dot(b.along) < 0 ? -1.0 : 1.0;
      const Vec2 along = (a.length * a.along + sign * b.length * b.along).normalized();
      const auto interval = [&](const Side& side) {
        return ordered(along.dot(side.segment.a), along.dot(side.segment.b));
      };
      const auto [a_low, a_high] = interval(a);
      const auto [b_low, b_high] = interval(b);
      if (std::min(a_high, b_high) - std::max(a_low, b_low) < 0.5 * b.length) continue;
      const Vec2 across = perpendicular(along);
      const double separation = std::fabs(across.dot(a.middle - b.middle));
      if (separation < rules.min_side_m) continue;
      const double low = std::min(a_low, b_low), high = std::max(a_high, b_high);
      const double place = 0.5 * across.dot(a.middle + b.middle);
      pairs.push_back({i, j, along, high - low, separation, 0.5 * (low + high) * along + place * across});
    }
  return pairs;
}

/// The ideal rectangle of two pairs. Its orientation is the length-weighted mean of all four sides modulo a right
/// angle, and its sides pass through their midpoints.
Rectangle ideal(const std::vector<Side>& sides, const Pair& p, const Pair& q) {
  const std::array<std::size_t, 4> members{p.a, p.b, q.a, q.b};
  Vec2 fourfold = Vec2::Zero();
  double seen = 0.0;
  for (const std::size_t m : members) {
    fourfold += sides[m].length * squared(squared(sides[m].along));
    seen += sides[m].length;
  }
  const double turn = 0.25 * portable::atan2(fourfold.y(), fourfold.x());  // modulo pi / 2
  const auto [sine, cosine] = portable::sincos(turn);
  Vec2 along(cosine, sine);
  if (std::fabs(along.dot(p.along)) < std::fabs(cross(along, p.along))) along = perpendicular(along);
  const Vec2 across = perpendicular(along);
  const auto [y0, y1] = ordered(across.dot(sides[p.a].middle), across.dot(sides[p.b].middle));
  const auto [x0, x1] = ordered(along.dot(sides[q.a].middle), along.dot(sides[q.b].middle));
  double certainty = std::min(1.0, seen / (2.0 * (x1 - x0 + y1 - y0)));
  for (const std::size_t m : members)
    certainty *= std::max(std::fabs(along.dot(sides[m].along)), std::fabs(across.dot(sides[m].along)));
  const auto corner = [&](double x, double y) -> Vec2 { return x * along + y * across; };
  return {{corner(x0, y0), corner(x1, y0), corner(x1, y1), corner(x0, y1)}, certainty};
}

bool completes(const Pair& p, const Pair& q, double sine, const RectangleRules& rules) {
  if (std::fabs(p.along.dot(q.along)) > sine) return false;  // also if they share a side
  const auto fits = [&](double extent, double separation) {
    return std::fabs(extent - separation) <= rules.misfit * std::max(extent, separation);
  };
  return fits(p.extent, q.separation) && fits(q.extent, p.separation) &&
         (p.centre - q.centre).norm() <= rules.misfit * std::max(p.separation, q.separation);
}

}  // namespace

std::vector<Rectangle> rectangles_of(std::span<const Segment> segments, const RectangleRules& rules) {
  const std::vector<Side> sides = sides_of(segments);
  const std::vector<Pair> pairs = parallel_pairs(sides, rules);
  const double sine = portable::sincos(rules.angle_rad).sin;
  std::vector<Rectangle> candidates;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    for (std::size_t j = i + 1; j < pairs.size(); ++j) {
      if (!completes(pairs[i], pairs[j], sine, rules)) continue;
      const Rectangle rectangle = ideal(sides, pairs[i], pairs[j]);
      if (rectangle.certainty >= rules.min_certainty) candidates.push_back(rectangle);
    }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Rectangle& a, const Rectangle& b) { return a.certainty > b.certainty; });
  std::vector<Rectangle> kept;
  for (const Rectangle& c : candidates)
    if (std::ranges::none_of(kept,
                             [&](const Rectangle& k) { return (k.centre() - c.centre()).norm() < rules.apart_m; }))
      kept.push_back(c);
  return kept;
}

}  // namespace scanbench::align::ffs
