// Finds the pairs that cost less than T_p and replaces parents by children.
#include "algorithms/map/dse/pairing.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "algorithms/map/dse/neighbours.hpp"

namespace scanbench::mapping::dse {
namespace {

/// Appends the strokes without children, pieces of one stroke joined where they meet.
void append_childless(std::span<const Stroke> strokes, std::span<const int> children, std::vector<Stroke>& result) {
  bool open = false;  // the last stroke of the result is a piece that can go on
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    const Stroke& s = strokes[i];
    const bool goes_on = open && s.cut_of >= 0 && result.back().cut_of == s.cut_of && children[i] == 0;
    open = children[i] == 0;
    if (goes_on) {
      result.back().segment.b = s.segment.b;
      result.back().members += s.members;
      result.back().points += s.points;
    } else if (open) {
      result.push_back(s);
    }
  }
}

}  // namespace

std::vector<Pairing> pairings(std::span<const Stroke> map, std::span<const Stroke> scan,
                              std::span<const Vec2> directions, const PairingRule& rule) {
  std::vector<Pairing> candidates;
  const double reach = reach_of(rule.merge);
  for (std::size_t i = 0; i < map.size(); ++i)
    for (std::size_t k = 0; k < scan.size(); ++k) {
      const Segment &g = map[i].segment, &s = scan[k].segment;
      if (!boxes_meet(g, s, reach) || (rule.same_side && opposed(g, s))) continue;
      const auto child = cheapest_child(g, s, directions, rule.merge, weights_of(map[i], scan[k], rule.placement));
      if (child && child->cost < rule.threshold_m) candidates.push_back({i, k, *child});
    }
  std::ranges::sort(candidates, [](const Pairing& a, const Pairing& b) {
    return std::tie(a.child.cost, a.map, a.scan) < std::tie(b.child.cost, b.map, b.scan);
  });
  std::vector<int> of_map(map.size(), 0), of_scan(scan.size(), 0);
  std::erase_if(candidates, [&](const Pairing& pair) {
    if (of_map[pair.map] >= rule.most_children || of_scan[pair.scan] >= rule.most_children) return true;
    ++of_map[pair.map];
    ++of_scan[pair.scan];
    return false;
  });
  return candidates;
}

std::vector<Stroke> paired(std::span<const Stroke> map, std::span<const Stroke> scan, std::span<const Pairing> pairs,
                           int now) {
  std::vector<int> of_map(map.size(), 0), of_scan(scan.size(), 0);
  for (const Pairing& pair : pairs) {
    ++of_map[pair.map];
    ++of_scan[pair.scan];
  }
  std::vector<Stroke> result;
  append_childless(map, of_map, result);
  for (Stroke& stroke : result) stroke.cut_of = -1;
  append_childless(scan, of_scan, result);
  for (Stroke& stroke : result) stroke.cut_of = -1;
  for (const Pairing& pair : pairs) {
    const Stroke &g = map[pair.map], &s = scan[pair.scan];
    const double share_g = 1.0 / of_map[pair.map], share_s = 1.0 / of_scan[pair.scan];
    result.push_back({.segment = pair.child.segment,
                      .created = now,
                      .members = share_g * g.members + share_s * s.members,
                      .points = share_g * g.points + share_s * s.points});
  }
  return result;
}

}  // namespace scanbench::mapping::dse
