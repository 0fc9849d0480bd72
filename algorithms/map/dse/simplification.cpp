// Merges pairs by increasing cost.
#include "algorithms/map/dse/simplification.hpp"

#include <functional>
#include <queue>
#include <tuple>

#include "algorithms/map/dse/neighbours.hpp"

namespace scanbench::mapping::dse {
namespace {

struct Candidate {
  std::size_t first = 0;
  std::size_t second = 0;
  Child child;
  bool operator>(const Candidate& other) const {
    return std::tie(child.cost, first, second) > std::tie(other.child.cost, other.first, other.second);
  }
};

}  // namespace

std::vector<Stroke> simplified(std::vector<Stroke> strokes, std::span<const Vec2> directions,
                               const SimplificationRule& rule, int now) {
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> heap;
  std::vector<bool> merged_away(strokes.size(), false);
  const double reach = reach_of(rule.merge);
  const auto consider = [&](std::size_t i, std::size_t k) {
    const Segment &s = strokes[i].segment, &t = strokes[k].segment;
    if (!boxes_meet(s, t, reach) || (rule.same_side && opposed(s, t))) return;
    const auto child = cheapest_child(s, t, directions, rule.merge, weights_of(strokes[i], strokes[k], rule.placement));
    if (child && child->cost < rule.threshold_m) heap.push({i, k, *child});
  };
  for (std::size_t k = 1; k < strokes.size(); ++k)
    for (std::size_t i = 0; i < k; ++i) consider(i, k);

  while (!heap.empty()) {
    const Candidate best = heap.top();
    heap.pop();
    if (merged_away[best.first] || merged_away[best.second]) continue;
    merged_away[best.first] = merged_away[best.second] = true;
    const std::size_t made = strokes.size();
    strokes.push_back({.segment = best.child.segment,
                       .created = now,
                       .members = strokes[best.first].members + strokes[best.second].members,
                       .points = strokes[best.first].points + strokes[best.second].points});
    merged_away.push_back(false);
    for (std::size_t i = 0; i < made; ++i)
      if (!merged_away[i]) consider(i, made);
  }
  std::vector<Stroke> left;
  for (std::size_t i = 0; i < strokes.size(); ++i)
    if (!merged_away[i]) left.push_back(strokes[i]);
  return left;
}

}  // namespace scanbench::mapping::dse
