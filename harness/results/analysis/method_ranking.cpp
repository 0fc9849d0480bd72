// Groups scenarios with the same pipelines and ranks these pipelines.
#include "harness/results/analysis/method_ranking.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/distributions.hpp"
#include "core/pareto.hpp"
#include "core/special_values.hpp"
#include "harness/results/analysis/gates.hpp"
#include "harness/runs/store/run_folder.hpp"

namespace scanbench::results {
namespace {

using metrics::MetricDescription;
using metrics::MetricRow;

/// What rankings are about: lines that were found, walls that a map covers, errors of poses, lines missed. The first
/// that most pipelines have decides. Distances of points from their lines are not in the list: many short lines, or few
/// easy ones, have small distances.
constexpr std::array<std::string_view, 7> kQuality{"f1",           "covered_5cm",  "position_error", "pose_efficiency",
                                                   "rpe_position", "ate_position", "missed"};

double clopper_pearson(double trials, double successes, bool upper) {
  return (upper ? share_upper_bound : share_lower_bound)(trials, successes, 0.025);
}

/// The cells of one group of scenarios.
class Ranker {
 public:
  Ranker(std::vector<std::string> scenarios, std::vector<std::string> pipelines, const std::vector<CellResults>& cells,
         const std::map<runs::CellKey, double>& seconds)
      : pipelines_(std::move(pipelines)), seconds_(seconds) {
    ranking_.scenarios = std::move(scenarios);
    const std::set<std::string> of_group(ranking_.scenarios.begin(), ranking_.scenarios.end());
    for (const auto& cell : cells)
      if (of_group.contains(cell.key.scenario) && cell.requested) cells_[cell.key.pipeline].push_back(&cell);
  }

  /// No methods: no metric of the list.
  MethodRanking rank(const std::map<std::string, MetricDescription>& descriptions) {
    std::size_t most = 0;
    for (const std::string_view metric : kQuality) {
      const auto known = descriptions.find(std::string(metric));
      if (known == descriptions.end() || known->second.direction == metrics::Direction::neither) continue;
      const std::size_t pipelines = pipelines_with(metric);
      if (pipelines <= most) continue;
      most = pipelines;
      ranking_.quality = known->second;
    }
    if (ranking_.quality.metric.empty()) return std::move(ranking_);
    for (const auto& pipeline : pipelines_) add(pipeline);
    sort();
    for (std::size_t i = 0; i + 1 < ranking_.methods.size(); ++i) compare_with_next(i);
    mark_front();
    return std::move(ranking_);
  }

 private:
  using Place = std::pair<std::string, std::uint64_t>;  // scenario, seed

  /// How many pipelines have values of the metric; 0 if no pipeline has any in one of the scenarios.
  std::size_t pipelines_with(std::string_view metric) const {
    std::set<std::string> pipelines;
    std::set<std::string> scenarios;
    for (const auto& [pipeline, cells] : cells_)
      for (const CellResults* cell : cells)
        if (std::isfinite(value_in(cell->rows, metric))) {
          pipelines.insert(pipeline);
          scenarios.insert(cell->key.scenario);
        }
    return scenarios.size() == ranking_.scenarios.size() ? pipelines.size() : 0;
  }

  void add(const std::string& pipeline) {
    RankedMethod method;
    method.pipeline = pipeline;
    method.beats_next = {kNaN, kNaN, kNaN, 0};
    std::map<std::uint64_t, std::pair<double, double>> by_seed;  // sum and count over the scenarios
    double log_seconds = 0.0;
    double timed = 0.0;
    for (const CellResults* cell : cells_.at(pipeline)) {
      ++method.cells;
      if (const auto time = seconds_.find(cell->key); time != seconds_.end() && time->second > 0) {
        log_seconds += std::log(time->second);
        timed += 1.0;
      }
      const double value = value_in(cell->rows, ranking_.quality.metric);
      if (!std::isfinite(value)) continue;
      ++method.defined;
      values_[pipeline][{cell->key.scenario, cell->key.seed}] = value;
      by_seed[cell->key.seed].first += value;
      by_seed[cell->key.seed].second += 1.0;
    }
    std::vector<double> averages;
    averages.reserve(by_seed.size());
    for (const auto& [seed, sum] : by_seed) averages.push_back(sum.first / sum.second);
    method.quality = mean_interval(averages);
    method.seconds = timed > 0 ? std::exp(log_seconds / timed) : kNaN;
    ranking_.methods.push_back(std::move(method));
  }

  double cost_of(const RankedMethod& method) const { return metrics::cost(ranking_.quality, method.quality.mean); }

  void sort() {
    std::ranges::stable_sort(ranking_.methods, {}, [this](const RankedMethod& method) {
      return std::tuple(!method.complete(), cost_of(method));
    });
  }

  void compare_with_next(std::size_t i) {
    RankedMethod& a = ranking_.methods[i];
    const RankedMethod& b = ranking_.methods[i + 1];
    if (!a.complete() || !b.complete()) return;
    const auto& theirs = values_.at(b.pipeline);
    std::map<std::uint64_t, std::pair<double, double>> wins;  // of a seed: won, and compared
    for (const auto& [place, value] : values_.at(a.pipeline)) {
      const auto other = theirs.find(place);
      if (other == theirs.end()) continue;
      auto& [won, compared] = wins[place.second];
      won += metrics::better(ranking_.quality, value, other->second)   ? 1.0
             : metrics::better(ranking_.quality, other->second, value) ? 0.0
                                                                       : 0.5;
      compared += 1.0;
    }
    const auto seeds = static_cast<double>(wins.size());
    if (seeds < 2.0) return;  // one seed says nothing about another
    double sum = 0.0;
    for (const auto& [seed, share] : wins) sum += share.first / share.second;
    a.beats_next = {sum / seeds, clopper_pearson(seeds, sum, false), clopper_pearson(seeds, sum, true),
                    std::ssize(wins)};
  }

  void mark_front() {
    std::vector<std::pair<double, double>> costs;
    for (const auto& method : ranking_.methods)
      costs.emplace_back(method.complete() ? method.seconds : kNaN, cost_of(method));
    for (const std::size_t i : pareto_front(costs)) ranking_.methods[i].on_front = true;
  }

  std::vector<std::string> pipelines_;
  const std::map<runs::CellKey, double>& seconds_;
  std::map<std::string, std::vector<const CellResults*>> cells_;
  std::map<std::string, std::map<Place, double>> values_;
  MethodRanking ranking_;
};

}  // namespace

std::span<const std::string_view> quality_metrics() {
  return kQuality;
}

double value_in(const std::vector<MetricRow>& rows, std::string_view metric) {
  double sum = 0.0;
  double count = 0.0;
  double mean = kNaN;
  for (const auto& row : rows) {
    if (row.metric != metric) continue;
    if (row.subject == "all") return row.value;
    if (row.subject == "mean") mean = row.value;
    sum += row.value;
    count += 1.0;
  }
  if (std::isfinite(mean)) return mean;
  return count > 0 ? sum / count : kNaN;
}

std::map<runs::CellKey, double> load_scan_seconds(const runs::RunStore& store, const std::vector<CellResults>& cells) {
  std::map<runs::CellKey, double> seconds;
  for (const auto& cell : cells)
    if (const auto known = cell.ok() ? store.scan_seconds(cell.key) : std::nullopt) seconds[cell.key] = *known;
  return seconds;
}

std::vector<MethodRanking> rank_methods(const std::vector<CellResults>& cells,
                                        const std::map<runs::CellKey, double>& seconds,
                                        const std::map<std::string, std::string>& conditions) {
  const auto condition_of = [&](const std::string& scenario) {
    const auto known = conditions.find(scenario);
    return known == conditions.end() ? std::string() : known->second;
  };
  std::vector<std::pair<std::string, std::vector<std::string>>> scenarios;  // in order, with their pipelines
  for (const auto& cell : cells) {
    if (!cell.requested) continue;
    if (scenarios.empty() || scenarios.back().first != cell.key.scenario) scenarios.push_back({cell.key.scenario, {}});
    auto& pipelines = scenarios.back().second;
    if (std::ranges::find(pipelines, cell.key.pipeline) == pipelines.end()) pipelines.push_back(cell.key.pipeline);
  }
  std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>> groups;  // pipelines, scenarios
  for (const auto& of_scenario : scenarios) {
    const std::string& scenario = of_scenario.first;
    const std::vector<std::string>& pipelines = of_scenario.second;
    const auto group = std::ranges::find_if(groups, [&](const auto& g) {
      return condition_of(g.second.front()) == condition_of(scenario) &&
             std::ranges::is_permutation(g.first, pipelines);
    });
    if (group != groups.end())
      group->second.push_back(scenario);
    else if (pipelines.size() > 1)
      groups.push_back({pipelines, {scenario}});
  }
  const auto descriptions = metric_descriptions();
  std::vector<MethodRanking> rankings;
  for (const auto& [pipelines, of_group] : groups)
    if (auto ranking = Ranker(of_group, pipelines, cells, seconds).rank(descriptions); !ranking.methods.empty()) {
      ranking.condition = condition_of(of_group.front());
      rankings.push_back(std::move(ranking));
    }
  return rankings;
}

}  // namespace scanbench::results
