// greedy_pairs: replaces the best matching pair of segments by one segment until no pair matches. A baseline without a
// paper.
//
// Unusable lines (not finite, without length, beyond 1e9 m) are dropped; if none is left, the status is degenerate. The
// map does not depend on the order of the lines or of their ends. More than 20 million pairs of near segments are a
// ParamError.
#include <algorithm>
#include <queue>

#include "algorithms/merge/parts/line_match.hpp"
#include "core/modules.hpp"
#include "core/number_text.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

constexpr std::size_t kMostPairs = 20'000'000;

class GreedyPairs final : public SegmentMerger {
 public:
  struct Params {
    double max_angle_deg = 10.0;
    double max_distance_m = 0.10;
    double max_gap_m = 0.0;
    static auto fields() { return merge::match_fields<Params>(); }
  };

  explicit GreedyPairs(const Params& p) : rules_(merge::match_tolerance(p)) {}

  MergeResult merge(const MergeInput& input, Trace& trace) const override;

 private:
  std::vector<std::vector<std::size_t>> neighbours(const std::vector<merge::Representative>& lines) const;

  merge::MatchTolerance rules_;
};

/// For each line, the lines near it, each once. The tolerances are doubled, because a merged segment moves and grows.
/// Lines that are farther apart are never compared.
std::vector<std::vector<std::size_t>> GreedyPairs::neighbours(const std::vector<merge::Representative>& lines) const {
  const merge::MatchTolerance wide{2 * rules_.angle_rad, 2 * rules_.distance_m, 2 * rules_.gap_m + rules_.distance_m};
  const merge::NearSegments near(lines, wide);
  std::vector<std::vector<std::size_t>> result(lines.size());
  std::vector<std::size_t> after;
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    after.clear();
    near.for_each_after(i, [&](std::size_t j) { after.push_back(j); });
    std::sort(after.begin(), after.end());
    after.erase(std::unique(after.begin(), after.end()), after.end());
    for (const std::size_t j : after) {
      if (!merge::match_cost(lines[i], lines[j], wide)) continue;
      if (++pairs > kMostPairs)
        throw ParamError("max_distance_m", "max_distance_m = " + number_text(rules_.distance_m) +
                                               " m makes more than " + std::to_string(kMostPairs) +
                                               " pairs of near segments; choose a smaller one");
      result[i].push_back(j);
      result[j].push_back(i);
    }
  }
  return result;
}

MergeResult GreedyPairs::merge(const MergeInput& input, Trace& trace) const {
  trace.stage(Stage::match);
  const merge::DistinctLines distinct = merge::distinct_lines(input.lines);
  std::vector<merge::Representative> nodes = distinct.representatives;
  std::vector<std::vector<std::size_t>> near = neighbours(nodes);

  struct Pair {
    double cost;
    std::size_t a;
    std::size_t b;
    bool operator>(const Pair& o) const {
      if (cost != o.cost) return cost > o.cost;
      return a != o.a ? a > o.a : b > o.b;
    }
  };
  std::priority_queue<Pair, std::vector<Pair>, std::greater<>> best;
  const auto consider = [&](std::size_t a, std::size_t b) {
    if (const auto cost = merge::match_cost(nodes[a], nodes[b], rules_)) best.push({*cost, a, b});
  };
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const std::size_t j : near[i])
      if (i < j) consider(i, j);

  trace.stage(Stage::merge);
  // Every merge makes a new node, which is the parent of the two merged ones. A node that is not merged is its own
  // parent.
  std::vector<std::size_t> parent(nodes.size());
  for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = i;
  const auto current_node = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  while (!best.empty()) {
    const Pair pair = best.top();
    best.pop();
    if (parent[pair.a] != pair.a || parent[pair.b] != pair.b) continue;  // one of the two is already merged
    const std::size_t node = nodes.size();
    nodes.push_back(merge::united(nodes[pair.a], nodes[pair.b]));
    parent.push_back(node);
    parent[pair.a] = parent[pair.b] = node;
    std::vector<std::size_t> around;
    for (const std::size_t side : {pair.a, pair.b}) {
      for (const std::size_t j : near[side]) around.push_back(current_node(j));
      near[side] = {};
    }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    std::erase(around, node);
    for (const std::size_t j : around) {
      near[j].push_back(node);
      consider(j, node);
    }
    near.push_back(std::move(around));
  }

  std::vector<int> group(distinct.representatives.size());
  std::vector<int> number(nodes.size(), -1);
  std::vector<merge::Representative> groups;
  for (std::size_t i = 0; i < group.size(); ++i) {
    const std::size_t node = current_node(i);
    if (number[node] < 0) {
      number[node] = static_cast<int>(groups.size());
      groups.push_back(nodes[node]);
    }
    group[i] = number[node];
  }
  return merge::result_of(input.lines, distinct, group, groups);
}

SCANBENCH_REGISTER(SegmentMerger, GreedyPairs,
                   {.name = "greedy_pairs",
                    .summary = "replaces the pair of segments that matches best by one segment, until no pair matches",
                    .reference = "baseline; compare Lakaemper, IROS 2009, section II"});

}  // namespace
}  // namespace scanbench
