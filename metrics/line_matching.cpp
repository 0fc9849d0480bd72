// Matching of found and true lines.
#include "metrics/line_matching.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"

namespace scanbench::metrics {
namespace {

// Far below what a scanner resolves, far above the rounding of a world file. Both are asked for, lest the short pieces
// of a curved wall pass for one line.
constexpr double kCollinearOffset = 1e-3;
constexpr double kCollinearAngle = radians(0.1);

/// The two walls lie on one line and their extents touch.
bool continues(const Segment& s, const Segment& t) {
  const bool s_longer = s.length() >= t.length();
  const Segment& base = s_longer ? s : t;
  const Segment& other = s_longer ? t : s;
  const Vec2 u = base.direction();
  if (std::fabs(cross(u, other.direction())) > std::sin(kCollinearAngle)) return false;
  if (std::fabs(cross(u, other.midpoint() - base.a)) > kCollinearOffset) return false;
  const double p = u.dot(other.a - base.a);
  const double q = u.dot(other.b - base.a);
  return std::min(p, q) <= base.length() + kCollinearOffset && std::max(p, q) >= -kCollinearOffset;
}

/// The longest segment between the ends of two collinear ones, directed as the first.
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
    while (root[i] != i) i = root[i];
    return i;
  };
  for (std::size_t i = 0; i < walls.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (continues(walls[i].segment, walls[j].segment)) {
        const auto [low, high] = std::minmax({find(i), find(j)});
        root[high] = low;
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
      Segment& s = surfaces.segments[static_cast<std::size_t>(surface)];
      s = hull(s, walls[i].segment);
    }
  }
  return surfaces;
}

std::vector<TrueLine> true_lines(const MetricInput& input, std::size_t frame, const Surfaces& surfaces,
                                 const TrueLineRule& rule) {
  const Scan scan = input.observed.scan(frame);
  const auto beams = static_cast<std::size_t>(scan.beams());
  const std::span true_ranges = std::span(input.truth->ranges).subspan(frame * beams, beams);
  const std::span wall_ids = std::span(input.truth->wall_ids).subspan(frame * beams, beams);
  const auto surface = [&](std::size_t i) {
    return wall_ids[i] < 0 ? -1 : surfaces.of_wall[static_cast<std::size_t>(wall_ids[i])];
  };
  std::vector<TrueLine> lines;
  for (std::size_t begin = 0, end = 0; begin < beams; begin = end) {
    end = begin + 1;
    while (end < beams && surface(end) == surface(begin)) ++end;
    if (surface(begin) < 0) continue;
    TrueLine line{.segment = {}, .surface = surface(begin)};
    for (std::size_t i = begin; i < end; ++i) {
      const int beam = static_cast<int>(i);
      if (!scan.valid(beam)) continue;
      const Vec2 p = true_ranges[i] * scan.sensor.geometry.direction(beam);
      if (line.beams == 0) {
        line.first_beam = beam;
        line.segment.a = p;
      }
      line.last_beam = beam;
      line.segment.b = p;
      ++line.beams;
    }
    const double length = line.segment.length();
    if (line.beams >= std::max(rule.min_beams, 2) && length >= rule.min_length_m && length > 0) lines.push_back(line);
  }
  return lines;
}

Overlap overlap(const Segment& found, const Segment& truth) {
  const Vec2 u = truth.direction();
  const Vec2 d = found.direction();
  const double length = truth.length();
  const double p = u.dot(found.a - truth.a);
  const double q = u.dot(found.b - truth.a);
  Overlap result;
  result.length_m = std::max(0.0, std::min(length, std::max(p, q)) - std::max(0.0, std::min(p, q)));
  result.union_m = std::max({length, p, q}) - std::min({0.0, p, q});
  result.offset_m = cross(u, found.midpoint() - truth.a);
  result.angle_rad = wrap_direction(std::atan2(cross(u, d), u.dot(d)));
  return result;
}

LineMatching match_lines(std::span<const LineFeature> found, std::span<const TrueLine> truth, const MatchRule& rule) {
  struct Candidate {
    double overlap_m;
    std::size_t line;
    std::size_t truth;
  };
  std::vector<Candidate> candidates;
  LineMatching result;
  result.merged.assign(found.size(), false);
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Segment& segment = found[k].segment;
    const bool is_long = segment.length() >= rule.min_length_m;
    result.outcome.push_back(is_long ? Outcome::false_line : Outcome::passed_over);
    result.truth.push_back(-1);
    int covered_surface = -1;
    for (std::size_t t = 0; t < truth.size(); ++t) {
      const Overlap o = overlap(segment, truth[t].segment);
      const double length = truth[t].segment.length();
      // A line at an angle is shorter in projection: that is the extent that the overlap is a share of.
      const double projected = segment.length() * std::cos(o.angle_rad);
      const bool matches = std::fabs(o.angle_rad) <= rule.max_angle_rad && std::fabs(o.offset_m) <= rule.max_offset_m &&
                           o.length_m > rule.min_overlap * std::min(length, projected);
      if (!matches) continue;
      candidates.push_back({o.length_m, k, t});
      result.outcome[k] = Outcome::split;
      if (o.length_m > 0.5 * length) {
        if (covered_surface >= 0 && covered_surface != truth[t].surface) result.merged[k] = true;
        covered_surface = truth[t].surface;
      }
    }
  }
  std::ranges::stable_sort(candidates, std::ranges::greater{}, &Candidate::overlap_m);
  std::vector<bool> taken(truth.size(), false);
  for (const Candidate& c : candidates) {
    if (result.truth[c.line] >= 0 || taken[c.truth]) continue;
    result.outcome[c.line] = Outcome::true_line;
    result.truth[c.line] = static_cast<int>(c.truth);
    taken[c.truth] = true;
  }
  return result;
}

}  // namespace scanbench::metrics
