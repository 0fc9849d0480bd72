// Matching, uniting and neighbour search of segments.
#include "algorithms/merge/parts/line_match.hpp"

#include <algorithm>
#include <cmath>

#include "core/index.hpp"
#include "core/special_values.hpp"

namespace scanbench::merge {
namespace {

double direction_of(const Vec2& doubled, double otherwise) {
  if (doubled.squaredNorm() == 0) return otherwise;
  return direction_mod_pi(0.5 * std::atan2(doubled.y(), doubled.x()));
}

Vec2 unit(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace

Representative representative_of(const Segment& segment, double multiplicity) {
  const double weight = multiplicity * segment.length();
  return {segment, weight, weight * unit(2.0 * segment.direction_angle()), segment.midpoint()};
}

Representative united(const Representative& a, const Representative& b) {
  Representative r;
  r.weight = a.weight + b.weight;
  r.doubled = a.doubled + b.doubled;
  r.middle = a.middle + (b.weight / r.weight) * (b.middle - a.middle);
  const Vec2 along = unit(direction_of(r.doubled, a.segment.direction_angle()));
  double start = kInf;
  double end = -start;
  for (const Vec2& p : {a.segment.a, a.segment.b, b.segment.a, b.segment.b}) {
    start = std::min(start, along.dot(p - r.middle));
    end = std::max(end, along.dot(p - r.middle));
  }
  r.segment = {r.middle + start * along, r.middle + end * along};
  return r;
}

std::optional<double> match_cost(const Representative& a, const Representative& b, const MatchTolerance& rules) {
  const double turn = std::abs(wrap_direction(a.segment.direction_angle() - b.segment.direction_angle()));
  if (turn > rules.angle_rad) return std::nullopt;
  const Vec2 along = unit(direction_of(a.doubled + b.doubled, a.segment.direction_angle()));
  const Vec2 between = b.segment.midpoint() - a.segment.midpoint();
  const double lateral = std::abs(cross(along, between));
  if (lateral > rules.distance_m) return std::nullopt;
  const double half_lengths =
      0.5 * (std::abs(along.dot(a.segment.b - a.segment.a)) + std::abs(along.dot(b.segment.b - b.segment.a)));
  if (std::abs(along.dot(between)) - half_lengths > rules.gap_m + 1e-9) return std::nullopt;
  const double t = turn / std::max(rules.angle_rad, 1e-300);
  const double l = lateral / std::max(rules.distance_m, 1e-300);
  return t * t + l * l;
}

DistinctLines distinct_lines(std::span<const MapLine> lines) {
  // sigma is used here only to limit the coordinates.
  const JointSpace space = split_lines(lines, kFarthest / kMostSigmas, kInf);
  DistinctLines distinct;
  distinct.of_line.assign(lines.size(), -1);
  std::vector<std::pair<Segment, double>> counted;
  for (const Piece& piece : space.pieces) {
    if (counted.empty() || !(counted.back().first == piece.segment)) counted.emplace_back(piece.segment, 0.0);
    counted.back().second += 1.0;
    distinct.of_line[piece.line] = static_cast<int>(counted.size()) - 1;
  }
  for (const auto& [segment, count] : counted) distinct.representatives.push_back(representative_of(segment, count));
  return distinct;
}

NearSegments::NearSegments(std::span<const Representative> segments, const MatchTolerance& rules) {
  double total = 0.0;
  for (const Representative& r : segments) total += r.segment.length();
  // Points at most `spacing` apart along each segment; the spacing grows with the total length to limit memory.
  const double spacing = std::max({0.5, rules.distance_m + rules.gap_m, total / 4e6});
  for (std::size_t i = 0; i < segments.size(); ++i) {
    first_.push_back(points_.size());
    const Segment& s = segments[i].segment;
    const int count = static_cast<int>(std::ceil(s.length() / spacing));
    for (int k = 0; k < std::max(1, count); ++k) {
      const Vec2 p = s.a + ((k + 0.5) / std::max(1, count)) * (s.b - s.a);
      points_.emplace_back(p.x(), p.y(), 0.0);
      owner_.push_back(i);
    }
  }
  first_.push_back(points_.size());
  // Matching segments are this close to each other at some place, and a grid point is at most half a spacing from
  // there. This also holds for long pairs whose ends diverge.
  reach_ = spacing + std::hypot(2.0 * rules.distance_m, rules.gap_m) + 1e-6;
  grid_.emplace(points_, reach_);
}

MergeResult result_of(std::span<const MapLine> lines, const DistinctLines& distinct, const std::vector<int>& group,
                      const std::vector<Representative>& groups) {
  MergeResult result;
  for (const Representative& g : groups) {
    MapLine line;
    // Along (cos t, sin t), t in [0, pi), independent of the directions of the members.
    const Vec2 along = unit(g.segment.direction_angle());
    const bool forward = along.dot(g.segment.b - g.segment.a) >= 0;
    line.segment = forward ? g.segment : Segment{g.segment.b, g.segment.a};
    line.members = 0;
    result.map.lines.push_back(line);
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const int r = distinct.of_line[i];
    result.labels.push_back(r < 0 ? -1 : group[as_index(r)]);
    if (r < 0) continue;
    MapLine& line = result.map.lines[as_index(result.labels.back())];
    line.members += lines[i].members;
    line.points += lines[i].points;
  }
  if (groups.empty() && !lines.empty()) result.status = Status::degenerate;
  return result;
}

}  // namespace scanbench::merge
