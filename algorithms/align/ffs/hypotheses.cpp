// Detection, plotting and tracking of hypotheses.
#include "algorithms/align/ffs/hypotheses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/contracts/force_field_trace.hpp"

namespace scanbench::align::ffs {
namespace {

constexpr double kSameSteps = 5.0;
constexpr std::size_t kRectangleSides = 4;

double distance_to_line(const Vec2& p, const Hypothesis& line) {
  const Vec2 along = (line.corners[1] - line.corners[0]).normalized();
  return std::fabs(cross(along, p - line.corners[0]));
}

/// Distance by which a hypothesis has moved from another of its kind.
double moved(const Hypothesis& from, const Hypothesis& to) {
  double farthest = 0.0;
  if (from.shape == Shape::line) {
    for (const Vec2& end : to.corners) farthest = std::max(farthest, distance_to_line(end, from));
    return farthest;
  }
  for (const Vec2& corner : to.corners) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec2& other : from.corners) nearest = std::min(nearest, (corner - other).norm());
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

void write(const Hypothesis& h, Fate fate, const CurrentMap& map, Trace& trace) {
  const auto corner = [&](std::size_t k) -> Vec2 {
    return map.world_from_map * h.corners[std::min(k, h.corners.size() - 1)];
  };
  const Vec2 a = corner(0), b = corner(1), c = corner(2), d = corner(3);
  trace.row(force_field::HypothesisRow{map.iteration, static_cast<int>(h.shape), h.id, static_cast<int>(fate),
                                       h.certainty, a.x(), a.y(), b.x(), b.y(), c.x(), c.y(), d.x(), d.y()});
}

}  // namespace

std::vector<Hypothesis> hypotheses_of(const CurrentMap& map, const HypothesisRules& rules) {
  std::vector<Hypothesis> result;
  if (map.points.size() == 0) return result;
  if (rules.line_weight > 0) {
    for (const HoughLine& line : hough_lines(map.points.at, rules.lines)) {
      const Segment part = clipped(line, map.points.at);
      if (part.length() > 0) result.push_back({Shape::line, {part.a, part.b}, line.certainty, -1});
    }
  }
  if (rules.rectangle_weight > 0) {
    for (const Rectangle& r : rectangles_of(prototypes_of(map.lines, rules.prototypes), rules.rectangles))
      result.push_back({Shape::rectangle, {r.corners.begin(), r.corners.end()}, r.certainty, -1});
  }
  return result;
}

VirtualScan plotted(const std::vector<Hypothesis>& hypotheses, const HypothesisRules& rules) {
  VirtualScan scan;
  for (std::size_t h = 0; h < hypotheses.size(); ++h) {
    const std::vector<Vec2>& corners = hypotheses[h].corners;
    const bool is_line = hypotheses[h].shape == Shape::line;
    const double weight = (is_line ? rules.line_weight : rules.rectangle_weight) * hypotheses[h].certainty;
    if (!(weight > 0)) continue;
    const std::size_t sides = is_line ? 1 : corners.size();
    for (std::size_t k = 0; k < sides; ++k) {
      const Segment side{corners[k], corners[(k + 1) % corners.size()]};
      resample(side, rules.resample_m, scan.points);
      scan.directions.resize(scan.points.size(), side.direction());
      scan.side.resize(scan.points.size(), is_line ? -1 : static_cast<int>(kRectangleSides * h + k));
    }
    scan.weights.resize(scan.points.size(), weight);
  }
  return scan;
}

void HypothesisJournal::follow(const CurrentMap& map, std::vector<Hypothesis>& hypotheses, Trace& trace) {
  if (!trace.recording()) return;
  std::vector<bool> taken(last_.size(), false);
  for (Hypothesis& h : hypotheses) {
    double nearest = kSameSteps * step_m_;
    std::size_t before = last_.size();
    for (std::size_t k = 0; k < last_.size(); ++k) {
      if (taken[k] || last_[k].shape != h.shape) continue;
      const double distance = moved(last_[k], h);
      if (distance <= nearest) nearest = distance, before = k;
    }
    const bool known = before < last_.size();
    if (known) taken[before] = true;
    h.id = known ? last_[before].id : next_id_++;
    write(h, !known ? Fate::born : nearest <= step_m_ ? Fate::confirmed : Fate::changed, map, trace);
  }
  for (std::size_t k = 0; k < last_.size(); ++k)
    if (!taken[k]) write(last_[k], Fate::dropped, map, trace);
  last_ = hypotheses;
}

}  // namespace scanbench::align::ffs
