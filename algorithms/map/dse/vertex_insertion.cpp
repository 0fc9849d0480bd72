// Projects end points and cuts segments there.
#include "algorithms/map/dse/vertex_insertion.hpp"

#include <algorithm>
#include <cmath>

namespace scanbench::mapping::dse {
namespace {

/// The stroke with the point closest to p, and that point's distance from the stroke's first end.
struct Foot {
  std::size_t stroke = 0;
  double along_m = 0.0;
  double distance_m = 0.0;
};

Foot closest(std::span<const Stroke> strokes, const Vec2& p) {
  Foot best{.distance_m = INFINITY};
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    const Segment& s = strokes[i].segment;
    const double along = std::clamp(s.direction().dot(p - s.a), 0.0, s.length());
    const double distance = (p - (s.a + along * s.direction())).norm();
    if (distance < best.distance_m) best = {i, along, distance};
  }
  return best;
}

/// The cuts of one stroke in order, those too near to an end or to the cut before left out.
std::vector<double> spaced(std::vector<double> cuts, double length, double apart) {
  std::ranges::sort(cuts);
  std::vector<double> kept;
  double last = 0.0;
  for (const double cut : cuts) {
    if (!(cut - last > apart) || !(length - cut > apart)) continue;
    kept.push_back(cut);
    last = cut;
  }
  return kept;
}

}  // namespace

std::vector<Stroke> with_vertices(std::span<const Stroke> strokes, std::span<const Vec2> ends,
                                  const InsertionRule& rule) {
  std::vector<std::vector<double>> cuts(strokes.size());
  if (!strokes.empty())
    for (const Vec2& end : ends)
      if (const Foot foot = closest(strokes, end); foot.distance_m < rule.reach_m)
        cuts[foot.stroke].push_back(foot.along_m);
  std::vector<Stroke> pieces;
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    const Stroke& whole = strokes[i];
    const double length = whole.segment.length();
    const std::vector<double> vertices = spaced(std::move(cuts[i]), length, rule.apart_m);
    Stroke piece = whole;
    piece.cut_of = static_cast<int>(i);
    double from = 0.0;
    for (std::size_t v = 0; v <= vertices.size(); ++v) {
      const bool last = v == vertices.size();
      const double to = last ? length : vertices[v];
      piece.segment.b = last ? whole.segment.b : Vec2(whole.segment.a + to * whole.segment.direction());
      if (!vertices.empty()) {
        piece.members = whole.members * (to - from) / length;
        piece.points = whole.points * (to - from) / length;
      }
      pieces.push_back(piece);
      piece.segment.a = piece.segment.b;
      from = to;
    }
  }
  return pieces;
}

std::vector<Vec2> ends_of(std::span<const Stroke> strokes) {
  std::vector<Vec2> ends;
  for (const Stroke& stroke : strokes) {
    ends.push_back(stroke.segment.a);
    ends.push_back(stroke.segment.b);
  }
  return ends;
}

}  // namespace scanbench::mapping::dse
