// Chains segments by their nearest free ends.
#include "algorithms/map/dse/polylines.hpp"

#include <limits>

namespace scanbench::mapping::dse {
namespace {

const Vec2& first_end(std::span<const Segment> segments, const Link& link) {
  const Segment& s = segments[link.segment];
  return link.flipped ? s.b : s.a;
}
const Vec2& last_end(std::span<const Segment> segments, const Link& link) {
  const Segment& s = segments[link.segment];
  return link.flipped ? s.a : s.b;
}

}  // namespace

std::vector<Polyline> generalized_polylines(std::span<const Segment> segments, double max_gap_m) {
  if (segments.empty()) return {};
  std::vector<bool> used(segments.size(), false);
  used[0] = true;
  std::vector<Polyline> polylines{{Link{0, false}}};
  for (std::size_t n = 1; n < segments.size(); ++n) {
    const Vec2 end = last_end(segments, polylines.back().back());
    Link next;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < segments.size(); ++i) {
      if (used[i]) continue;
      for (const bool flipped : {false, true}) {
        const double gap = (first_end(segments, {i, flipped}) - end).norm();
        if (gap < nearest) {
          nearest = gap;
          next = {i, flipped};
        }
      }
    }
    used[next.segment] = true;
    if (nearest > max_gap_m) polylines.emplace_back();
    polylines.back().push_back(next);
  }
  return polylines;
}

int vertices(std::span<const Segment> segments, std::span<const Polyline> polylines, double joined_m) {
  int count = 0;
  for (const Polyline& polyline : polylines) {
    count += 2 * static_cast<int>(polyline.size());
    for (std::size_t k = 1; k < polyline.size(); ++k)
      if ((first_end(segments, polyline[k]) - last_end(segments, polyline[k - 1])).norm() <= joined_m) --count;
  }
  return count;
}

}  // namespace scanbench::mapping::dse
