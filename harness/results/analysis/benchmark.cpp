// Ranks the pipelines of a benchmark: averages over conditions and seeds, and tests the differences.
#include "harness/results/analysis/benchmark.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <set>
#include <tuple>

#include "core/index.hpp"
#include "core/special_values.hpp"
#include "harness/results/analysis/shared_best.hpp"

namespace scanbench::results {
namespace {

std::vector<std::string> scenario_names(const std::vector<study::Scenario>& scenarios) {
  std::vector<std::string> names;
  for (const auto& scenario : scenarios) names.push_back(scenario.name);
  return names;
}

std::vector<std::string> pipeline_names(const study::Scenario& scenario) {
  std::vector<std::string> names;
  for (const auto& pipeline : scenario.pipelines) names.push_back(pipeline.name);
  return names;
}

/// Divides each value by the baseline's in the same scenario and seed.
CellValues ratios_to(const CellValues& values, const std::string& baseline) {
  CellValues ratios;
  for (const auto& [key, value] : values) {
    const auto base = values.find({baseline, std::get<1>(key), std::get<2>(key)});
    if (base != values.end() && base->second > 0) ratios[key] = value / base->second;
  }
  return ratios;
}

double average(const std::vector<double>& values, bool geometric) {
  double sum = 0.0;
  double count = 0.0;
  for (const double v : values) {
    if (!std::isfinite(v) || (geometric && !(v > 0))) continue;
    sum += geometric ? std::log(v) : v;
    count += 1.0;
  }
  if (count == 0.0) return kNaN;
  return geometric ? std::exp(sum / count) : sum / count;
}

std::map<std::string, int> conditions_won(const CellValues& rank, const study::BenchmarkColumn& column,
                                          const std::vector<std::string>& pipelines,
                                          const std::vector<std::uint64_t>& seeds,
                                          const std::vector<std::string>& scenarios) {
  std::map<std::string, int> won;
  for (const auto& scenario : scenarios) {
    std::vector<double> means;
    for (const auto& pipeline : pipelines)
      means.push_back(average(per_seed(rank, pipeline, seeds, {scenario}), column.geometric));
    double best = kNaN;
    for (const double m : means)
      if (better(column.description(), m, best)) best = m;
    for (std::size_t i = 0; i < means.size(); ++i) won[pipelines[i]] += means[i] == best ? 1 : 0;
  }
  return won;
}

ConditionRange range_over(const CellValues& values, const std::string& pipeline,
                          const std::vector<std::uint64_t>& seeds, const std::vector<std::string>& scenarios,
                          bool geometric) {
  ConditionRange range{kNaN, kNaN};
  for (const auto& scenario : scenarios) {
    const double mean = average(per_seed(values, pipeline, seeds, {scenario}), geometric);
    range = {std::fmin(range.least, mean), std::fmax(range.most, mean)};
  }
  return range;
}

/// Whether a pipeline has a value in every cell of these scenarios.
bool is_complete(const CellValues& values, const std::string& pipeline, const std::vector<std::uint64_t>& seeds,
                 const std::vector<std::string>& scenarios) {
  return std::ranges::all_of(seeds, [&](std::uint64_t seed) {
    return std::ranges::all_of(scenarios, [&](const std::string& scenario) {
      const auto found = values.find({pipeline, seed, scenario});
      return found != values.end() && std::isfinite(found->second);
    });
  });
}

}  // namespace

std::string next_head(const study::BenchmarkColumn& rank) {
  return rank.geometric ? rank.name() + " over next" : rank.name() + " − next";
}

CellValues values_of(const std::vector<runs::SummaryRow>& rows, const std::string& metric) {
  CellValues values;
  for (const auto& row : rows)
    if (row.metric == metric && row.subject == "all") values[{row.pipeline, row.seed, row.scenario}] = row.value;
  return values;
}

std::vector<double> per_seed(const CellValues& values, const std::string& pipeline,
                             const std::vector<std::uint64_t>& seeds, const std::vector<std::string>& scenarios,
                             bool geometric) {
  std::vector<double> averages;
  for (const std::uint64_t seed : seeds) {
    std::vector<double> of_seed;
    for (const auto& scenario : scenarios) {
      const auto found = values.find({pipeline, seed, scenario});
      if (found != values.end()) of_seed.push_back(found->second);
    }
    averages.push_back(average(of_seed, geometric));
  }
  return averages;
}

std::vector<std::uint64_t> seeds_of(const std::vector<runs::SummaryRow>& rows) {
  std::set<std::uint64_t> seeds;
  for (const auto& row : rows) seeds.insert(row.seed);
  return {seeds.begin(), seeds.end()};
}

double noise_m(const study::Scenario& scenario) {
  return std::get<study::SimulatedInput>(scenario.input).sensor.noise.sigma_m;
}

std::vector<RankedPipeline> rank_pipelines(const std::vector<study::Scenario>& scenarios,
                                           const std::vector<runs::SummaryRow>& rows,
                                           const study::BenchmarkSpec& spec) {
  if (scenarios.empty()) return {};
  const std::vector<std::string> names = pipeline_names(scenarios.front());
  const std::vector<std::string> conditions = scenario_names(scenarios);
  const std::vector<std::uint64_t> seeds = seeds_of(rows);
  std::map<std::string, RankedPipeline> by_name;
  std::map<std::string, std::vector<double>> rank_of;
  const study::BenchmarkSubject& subject = spec.subject();
  const study::BenchmarkColumn& rank = subject.rank_column();
  const CellValues rank_values = values_of(rows, rank.metric);
  const auto won = conditions_won(rank_values, rank, names, seeds, conditions);
  for (const auto& column : subject.columns) {
    const CellValues values = column.metric == "t_ratio"
                                  ? ratios_to(values_of(rows, subject.time_metric), spec.baseline)
                                  : values_of(rows, column.metric);
    for (const auto& name : names) {
      std::vector<double>& by_seed = by_name[name].by_seed[column.metric];
      by_seed = per_seed(values, name, seeds, conditions, column.geometric);
      by_name[name].values[column.metric] = seed_interval(by_seed, range_of(column.description()));
      if (column.shows_range)
        by_name[name].ranges[column.metric] = range_over(values, name, seeds, conditions, column.geometric);
    }
  }
  std::vector<RankedPipeline> ranking;
  for (const auto& name : names) {
    RankedPipeline& ranked = by_name[name];
    ranked.name = name;
    ranked.conditions_won = won.at(name);
    rank_of[name] = per_seed(rank_values, name, seeds, conditions, rank.geometric);
    if (rank.geometric)
      for (double& value : rank_of[name]) value = std::log(value);
    for (const auto& condition : conditions)
      for (const std::uint64_t seed : seeds) {
        const auto found = rank_values.find({name, seed, condition});
        ranked.missing += found == rank_values.end() || !std::isfinite(found->second) ? 1 : 0;
      }
    ranking.push_back(ranked);
  }
  const auto key = [&](const RankedPipeline& r) {
    const double cost = metrics::cost(rank.description(), r.values.at(rank.metric).mean);
    return std::tuple(r.missing > 0, !std::isfinite(cost), std::isfinite(cost) ? cost : 0.0, r.name);
  };
  std::ranges::sort(ranking, {}, key);

  for (std::size_t i = 0; i + 1 < ranking.size(); ++i) {
    std::vector<double> differences;
    std::ranges::transform(rank_of[ranking[i].name], rank_of[ranking[i + 1].name], std::back_inserter(differences),
                           std::minus<>{});
    ranking[i].next = seed_interval(differences, ValueRange::any);
  }
  return ranking;
}

std::vector<LevelResult> results_by_level(const std::vector<study::Scenario>& scenarios,
                                          const std::vector<runs::SummaryRow>& rows, const study::BenchmarkSpec& spec,
                                          const std::vector<std::string>& names) {
  const study::BenchmarkColumn& rank = spec.subject().rank_column();
  const CellValues values = values_of(rows, rank.metric);
  const std::vector<std::uint64_t> seeds = seeds_of(rows);
  const std::vector<std::string> in_run = scenario_names(scenarios);
  std::vector<LevelResult> results;
  for (const study::BenchmarkLevel& level : spec.levels) {
    std::vector<std::string> conditions;
    std::ranges::copy_if(level.scenarios, std::back_inserter(conditions),
                         [&](const auto& name) { return std::ranges::find(in_run, name) != in_run.end(); });
    if (conditions.empty()) continue;
    LevelResult result{level.factor, level.level, {}};
    std::vector<std::vector<double>>& by_seed = result.by_seed;
    for (const auto& name : names) {
      by_seed.push_back(is_complete(values, name, seeds, conditions)
                            ? per_seed(values, name, seeds, conditions, rank.geometric)
                            : std::vector<double>(seeds.size(), kNaN));
      result.values.push_back(seed_interval(by_seed.back(), range_of(rank.description())));
    }
    result.leaders = shared_best(by_seed, rank.description());
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace scanbench::results
