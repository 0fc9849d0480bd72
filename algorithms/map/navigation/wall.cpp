// Makes walls of points and unites them.
#include "algorithms/map/navigation/wall.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/interval.hpp"

namespace scanbench::mapping::navigation {
namespace {

/// Largest distance of the part of `probe` within the projection of `base` from the line of `base`.
double offset_over_overlap(const Segment& base, const Segment& probe) {
  const Vec2 u = base.direction();
  const Interval common = intersection({0.0, base.length()}, projection(probe, base.a, u));
  const Vec2 d = probe.b - probe.a;
  const double run = u.dot(d);
  const auto offset_at = [&](double along) {
    if (run == 0) return std::abs(cross(u, probe.midpoint() - base.a));
    const double t = std::clamp((along - u.dot(probe.a - base.a)) / run, 0.0, 1.0);
    return std::abs(cross(u, probe.a + t * d - base.a));
  };
  return std::max(offset_at(common.low), offset_at(common.high));
}

}  // namespace

MapWall wall_of(const Segment& segment, std::span<const Vec2> points) {
  MapWall wall{.segment = segment, .moments = PointMoments::of(points), .points = static_cast<int>(points.size())};
  if (points.empty()) {
    const Vec2 ends[] = {segment.a, segment.b};
    wall.moments = PointMoments::of(ends);
  }
  return wall;
}

bool same_surface(const Segment& s, const Segment& t, const UniteRule& rule) {
  if (s.direction().dot(t.direction()) < std::cos(rule.angle_rad)) return false;
  const bool s_longer = s.length() >= t.length();
  const Segment &base = s_longer ? s : t, &other = s_longer ? t : s;
  const Interval along = projection(other, base.a, base.direction());
  if (along.low > base.length() + rule.gap_m || along.high < -rule.gap_m) return false;
  return offset_over_overlap(base, other) <= rule.offset_m;
}

MapWall united(const MapWall& s, const MapWall& t) {
  MapWall result{
      .segment = s.segment, .moments = s.moments, .members = s.members + t.members, .points = s.points + t.points};
  result.moments.add(t.moments);
  const LineFit fit = fit_line(result.moments);
  Vec2 along = perpendicular(fit.normal);
  if (fit.degenerate) along = s.segment.direction();
  if (along.dot(s.segment.b - s.segment.a + t.segment.b - t.segment.a) < 0) along = -along;
  const Vec2& origin = result.moments.centroid();
  const Interval p = projection(s.segment, origin, along), q = projection(t.segment, origin, along);
  result.segment = {origin + std::min(p.low, q.low) * along, origin + std::max(p.high, q.high) * along};
  return result;
}

}  // namespace scanbench::mapping::navigation
