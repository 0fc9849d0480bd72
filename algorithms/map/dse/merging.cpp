// Places the line ld, projects both segments on it, and weighs parallelism, collinearity and proximity.
#include "algorithms/map/dse/merging.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/interval.hpp"

namespace scanbench::mapping::dse {
namespace {

constexpr double kNoLengthM = 1e-6;
constexpr double kLeastProjected = 0.1;  // of the length of both segments

/// The cost at the legible denominators; `angle` and `apart` are a_i and D_i of the two segments.
double cost_of(double l1, double l2, const double (&angle)[2], const double (&apart)[2], double r, double cos12,
               const MergeRule& rule) {
  const double scale = 1.0 / (1.0 + rule.k * cos12);
  switch (rule.form) {
    case CostForm::ratio_of_all:
      return r * (l1 * (angle[0] + apart[0]) + l2 * (angle[1] + apart[1])) * scale;
    case CostForm::ratio_of_distances:
      return (l1 * (angle[0] + r * apart[0]) + l2 * (angle[1] + r * apart[1])) * scale;
    case CostForm::ratio_added:
      break;
  }
  return (l1 * (angle[0] + r + apart[0]) + l2 * (angle[1] + r + apart[1])) * scale;
}

}  // namespace

std::optional<Child> merged(const Segment& s1, const Segment& s2, const Vec2& ad, const MergeRule& rule,
                            const Weights& weights) {
  const double l1 = s1.length(), l2 = s2.length();
  const double w1 = weights.first, w2 = weights.second;
  if (!(l1 + l2 > 0) || !(w1 + w2 > 0)) return std::nullopt;
  const Vec2 d1 = s1.direction(), d2 = s2.direction();
  // The free side of the child: along the parents, the longer one first.
  const double along = l1 * d1.dot(ad) + l2 * d2.dot(ad);
  const Vec2 u = along < 0 ? Vec2(-ad) : ad;
  const Vec2 n = perpendicular(u);
  // Coordinates are relative to an end of s1, so that large world coordinates cost no digits.
  const Vec2& origin = s1.a;
  const auto offset = [&](const Vec2& p) { return n.dot(p - origin); };
  const double c = (w1 * offset(s1.midpoint()) + w2 * offset(s2.midpoint())) / (w1 + w2);  // d1 w1 = d2 w2

  const Interval p1 = projection(s1, origin, u), p2 = projection(s2, origin, u);
  const double projected = p1.length() + p2.length();
  if (projected < kNoLengthM || projected < kLeastProjected * (l1 + l2)) return std::nullopt;
  if (std::max(p1.low, p2.low) - std::min(p1.high, p2.high) > rule.max_gap_m) return std::nullopt;
  const auto distance_of = [&](const Vec2& p) { return std::abs(offset(p) - c); };
  if (std::max({distance_of(s1.a), distance_of(s1.b), distance_of(s2.a), distance_of(s2.b)}) > rule.max_apart_m)
    return std::nullopt;
  const Interval hull{std::min(p1.low, p2.low), std::max(p1.high, p2.high)};

  const double angle[2] = {std::acos(std::min(1.0, std::abs(d1.dot(u)))),
                           std::acos(std::min(1.0, std::abs(d2.dot(u))))};
  const double apart[2] = {distance_of(s1.a) + distance_of(s1.b), distance_of(s2.a) + distance_of(s2.b)};
  const double cos12 = std::min(1.0, std::abs(d1.dot(d2)));
  const double r = hull.length() / projected;
  return Child{.segment = {origin + hull.low * u + c * n, origin + hull.high * u + c * n},
               .cost = cost_of(l1, l2, angle, apart, r, cos12, rule)};
}

std::optional<Child> cheapest_child(const Segment& l1, const Segment& l2, std::span<const Vec2> directions,
                                    const MergeRule& rule, const Weights& weights) {
  std::optional<Child> best;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    std::optional<Child> child = merged(l1, l2, directions[k], rule, weights);
    if (!child || (best && best->cost <= child->cost)) continue;
    best = child;
    best->direction = k;
  }
  return best;
}

}  // namespace scanbench::mapping::dse
