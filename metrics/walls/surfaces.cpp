// Joins walls with union-find: every pair of walls that continue each other becomes one set. An R-tree finds the pairs
// that are near enough, so that a world of n walls takes about n log n steps.
#include "metrics/walls/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "core/geometry/interval.hpp"
#include "core/geometry/segment_index.hpp"
#include "core/index.hpp"

namespace scanbench::metrics {
namespace {

// Far below what a scanner resolves, far above the rounding of a world file. Offset and angle are both limited: the
// short pieces of a curved wall are within the offset.
constexpr double kCollinearOffset = 1e-3;
constexpr double kCollinearAngle = radians(0.1);

/// True if the two walls are on one line and their extents touch.
bool continues(const Segment& s, const Segment& t) {
  const bool s_longer = s.length() >= t.length();
  const Segment& base = s_longer ? s : t;
  const Segment& other = s_longer ? t : s;
  const Vec2 u = base.direction();
  if (std::fabs(cross(u, other.direction())) > std::sin(kCollinearAngle)) return false;
  if (std::fabs(cross(u, other.midpoint() - base.a)) > kCollinearOffset) return false;
  const Interval extent = projection(other, base.a, u);
  return extent.low <= base.length() + kCollinearOffset && extent.high >= -kCollinearOffset;
}

/// The margin of a box about a wall that overlaps the boxes of all walls that continue it. Two such walls have points
/// that are at most kCollinearOffset apart along the longer one. Across it they are apart by kCollinearOffset at the
/// midpoint of the shorter one, and by the angle over half its length at its ends.
double reach(const Segment& s) {
  return 2.0 * kCollinearOffset + s.length() * std::sin(kCollinearAngle);
}

/// The longest segment between the ends of two collinear ones, with the direction of the first.
Segment hull(const Segment& s, const Segment& t) {
  Vec2 u = s.length() >= t.length() ? s.direction() : t.direction();
  if (u.dot(s.direction()) < 0) u = -u;
  const auto along = [&](const Vec2& p, const Vec2& q) { return u.dot(p) < u.dot(q); };
  return {std::min({s.a, s.b, t.a, t.b}, along), std::max({s.a, s.b, t.a, t.b}, along)};
}

}  // namespace

Surfaces join_walls(std::span<const Wall> walls) {
  std::vector<std::size_t> root(walls.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  std::vector<Segment> segments;
  std::vector<double> margins;
  for (const Wall& wall : walls) {
    segments.push_back(wall.segment);
    margins.push_back(reach(wall.segment));
  }
  const SegmentIndex index(segments, margins);
  for (std::size_t i = 0; i < walls.size(); ++i) {
    for (const std::size_t j : index.near({&segments[i], 1}, margins[i])) {
      if (j >= i || find(i) == find(j) || !continues(walls[i].segment, walls[j].segment)) continue;
      const auto [low, high] = std::minmax({find(i), find(j)});
      root[high] = low;
    }
  }

  Surfaces surfaces;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const std::size_t first = find(i);
    if (first == i) {
      surfaces.of_wall.push_back(static_cast<int>(surfaces.segments.size()));
      surfaces.segments.push_back(walls[i].segment);
    } else {
      const int surface = surfaces.of_wall[first];
      surfaces.of_wall.push_back(surface);
      Segment& s = surfaces.segments[as_index(surface)];
      s = hull(s, walls[i].segment);
    }
  }
  return surfaces;
}

}  // namespace scanbench::metrics
