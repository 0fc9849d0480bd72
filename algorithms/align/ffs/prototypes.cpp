// Greedy grouping of segments. Directions are unit vectors; no angles are computed.
#include "algorithms/align/ffs/prototypes.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/portable_math.hpp"

namespace scanbench::align::ffs {
namespace {

struct Prototype {
  Segment extent;
  Vec2 along;   ///< unit
  Vec2 middle;  ///< length-weighted mean
  double weight;
};

/// Distance of the midpoint of the shorter segment from the line of the longer one if they match; negative otherwise.
double distance_if_matching(const Prototype& a, const Prototype& b, double cosine, const PrototypeRules& rules) {
  if (std::fabs(a.along.dot(b.along)) < cosine) return -1.0;
  const Prototype &longer = a.weight >= b.weight ? a : b, &shorter = a.weight >= b.weight ? b : a;
  const double across = std::fabs(cross(longer.along, shorter.middle - longer.middle));
  if (across > rules.distance_m) return -1.0;
  const auto at = [&](const Vec2& p) { return longer.along.dot(p - longer.middle); };
  const double gap = std::max(
      std::min(at(shorter.extent.a), at(shorter.extent.b)) - std::max(at(longer.extent.a), at(longer.extent.b)),
      std::min(at(longer.extent.a), at(longer.extent.b)) - std::max(at(shorter.extent.a), at(shorter.extent.b)));
  return gap > rules.gap_m ? -1.0 : across;
}

void join(const Prototype& other, Prototype& into) {
  const double sign = into.along.dot(other.along) < 0 ? -1.0 : 1.0;
  const double weight = into.weight + other.weight;
  const Vec2 along = (into.weight * into.along + sign * other.weight * other.along).normalized();
  const Vec2 middle = (into.weight * into.middle + other.weight * other.middle) / weight;
  double low = 0.0, high = 0.0;
  for (const Vec2& p : {into.extent.a, into.extent.b, other.extent.a, other.extent.b}) {
    low = std::min(low, along.dot(p - middle));
    high = std::max(high, along.dot(p - middle));
  }
  into = {{middle + low * along, middle + high * along}, along, middle, weight};
}

}  // namespace

std::vector<Segment> prototypes_of(std::span<const Segment> segments, const PrototypeRules& rules) {
  const double cosine = portable::sincos(rules.angle_rad).cos;
  std::vector<Prototype> given;
  for (const Segment& s : segments)
    if (s.length() > 0) given.push_back({s, s.direction(), s.midpoint(), s.length()});
  std::stable_sort(given.begin(), given.end(), [](const auto& a, const auto& b) { return a.weight > b.weight; });

  std::vector<Prototype> prototypes;
  const auto nearest_to = [&](const Prototype& p) {
    std::size_t nearest = prototypes.size();
    double least = rules.distance_m;
    for (std::size_t k = 0; k < prototypes.size(); ++k) {
      const double distance = distance_if_matching(prototypes[k], p, cosine, rules);
      if (distance < 0 || distance > least || (distance == least && nearest < prototypes.size())) continue;
      least = distance;
      nearest = k;
    }
    return nearest;
  };
  for (const Prototype& p : given) {
    const std::size_t nearest = nearest_to(p);
    if (nearest < prototypes.size()) {
      join(p, prototypes[nearest]);
    } else {
      prototypes.push_back(p);
    }
  }
  for (std::size_t k = 0; k < prototypes.size();) {  // each join removes one prototype
    const Prototype candidate = prototypes[k];
    prototypes.erase(prototypes.begin() + static_cast<std::ptrdiff_t>(k));
    const std::size_t nearest = nearest_to(candidate);
    if (nearest < prototypes.size()) {
      join(candidate, prototypes[nearest]);
      k = 0;
    } else {
      prototypes.insert(prototypes.begin() + static_cast<std::ptrdiff_t>(k), candidate);
      ++k;
    }
  }
  std::vector<Segment> result;
  result.reserve(prototypes.size());
  for (const Prototype& p : prototypes) result.push_back(p.extent);
  return result;
}

}  // namespace scanbench::align::ffs
