// Matches found lines with true lines greedily by overlap.
#include "metrics/line_matching.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/interval.hpp"

namespace scanbench::metrics {

Overlap overlap(const Segment& found, const Segment& truth) {
  const Vec2 u = truth.direction();
  const Vec2 d = found.direction();
  const double length = truth.length();
  const Interval extent = projection(found, truth.a, u);
  Overlap result;
  result.length_m = std::max(0.0, intersection({0.0, length}, extent).length());
  result.union_m = std::max(length, extent.high) - std::min(0.0, extent.low);
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
    result.outcome.push_back(is_long ? Outcome::false_line : Outcome::ignored);
    result.truth.push_back(-1);
    int covered_surface = -1;
    for (std::size_t t = 0; t < truth.size(); ++t) {
      const Overlap o = overlap(segment, truth[t].segment);
      const double length = truth[t].segment.length();
      // The overlap is compared with the projection of the found line, which is shorter than the line itself.
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
