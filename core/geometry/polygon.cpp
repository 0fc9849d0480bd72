// Makes polygon records from lines and joins neighbours in corners. Siadat et al. 1997, section 6.
#include "core/geometry/polygon.hpp"

#include <cmath>
#include <optional>

namespace scanbench {
namespace {

std::array<float, 2> rounded(const Vec2& v) {
  return {static_cast<float>(v.x()) + 0.0F, static_cast<float>(v.y()) + 0.0F};  // + 0: no negative zeros
}

Vec2 exact(const std::array<float, 2>& v) {
  return {double{v[0]}, double{v[1]}};
}

// `normal` is used if the vertices coincide, which leaves the direction undefined.
PolygonSegment record(const Segment& s, Vec2 normal, int count) {
  PolygonSegment r;
  const double length = s.length();
  const bool valid = length > 0;
  const Vec2 direction = valid ? s.direction() : perpendicular(normal);
  if (valid) normal = -perpendicular(direction);  // the sensor is on the left: to the right is away from it
  double distance = normal.dot(s.a);
  if (distance < 0) {
    normal = -normal;
    distance = -distance;
  }
  r.v1 = rounded(s.a);
  r.v2 = rounded(s.b);
  r.direction = rounded(direction);
  r.normal = rounded(normal);
  r.length = static_cast<float>(length);
  r.distance = static_cast<float>(distance);
  r.count = static_cast<std::uint32_t>(count);
  r.flags = valid ? PolygonSegment::valid : 0U;
  return r;
}

std::optional<Vec2> intersection(const PolarLine& a, const PolarLine& b) {
  const Vec2 n = a.normal();
  const Vec2 m = b.normal();
  const double det = cross(n, m);
  if (det == 0) return std::nullopt;
  return Vec2((a.rho * m.y() - b.rho * n.y()) / det, (n.x() * b.rho - m.x() * a.rho) / det);
}

// The common vertex of two neighbours; empty if they are too far apart.
std::optional<Vec2> vertex(const LineFeature& before, const LineFeature& after, const JoinRules& rules) {
  const Vec2& end = before.segment.b;
  const Vec2& start = after.segment.a;
  if (!((end - start).norm() <= rules.gap_m)) return std::nullopt;
  if (line_difference(before.line, after.line).alpha > rules.corner_rad) {
    const auto corner = intersection(before.line, after.line);
    if (corner && (*corner - end).norm() <= rules.gap_m && (*corner - start).norm() <= rules.gap_m) return corner;
  }
  return Vec2(0.5 * (end + start));
}

}  // namespace

Segment PolygonSegment::segment() const {
  return {exact(v1), exact(v2)};
}

PolarLine PolygonSegment::line() const {
  return canonical(double{distance}, std::atan2(double{normal[1]}, double{normal[0]}));
}

PolygonSegment polygon_segment(const LineFeature& line) {
  return record(line.segment, line.line.normal(), line.points);
}

std::vector<PolygonSegment> polygon_of(const ScanLines& scan, const JoinRules& rules) {
  std::vector<Segment> segments;
  for (const auto& line : scan.lines) segments.push_back(line.segment);
  std::vector<std::uint32_t> joined(segments.size(), 0);
  for (std::size_t i = 0; i + 1 < segments.size(); ++i) {
    const auto corner = vertex(scan.lines[i], scan.lines[i + 1], rules);
    if (!corner) continue;
    segments[i].b = segments[i + 1].a = *corner;
    joined[i] = PolygonSegment::joined;
  }
  std::vector<PolygonSegment> polygon;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    polygon.push_back(record(segments[i], scan.lines[i].line.normal(), scan.lines[i].points));
    polygon.back().flags |= joined[i];
  }
  return polygon;
}

}  // namespace scanbench
