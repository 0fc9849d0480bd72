// Ranks the pipelines of a benchmark: averages over conditions and seeds, and tests the differences.
#include "harness/analysis/benchmark.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

namespace scanbench::harness {
namespace {

using metrics::Direction;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> scenario_names(const std::vector<Scenario>& scenarios) {
  std::vector<std::string> names;
  for (const auto& scenario : scenarios) names.push_back(scenario.name);
  return names;
}

std::vector<std::string> pipeline_names(const Scenario& scenario) {
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
  if (count == 0.0) return kNan;
  return geometric ? std::exp(sum / count) : sum / count;
}

std::map<std::string, int> conditions_won(const CellValues& f1, const std::vector<std::string>& pipelines,
                                          const std::vector<std::uint64_t>& seeds,
                                          const std::vector<std::string>& scenarios) {
  std::map<std::string, int> won;
  for (const auto& scenario : scenarios) {
    std::vector<double> means;
    for (const auto& pipeline : pipelines) means.push_back(average(per_seed(f1, pipeline, seeds, {scenario}), false));
    double best = -1.0;
    for (const double m : means) best = m > best ? m : best;
    for (std::size_t i = 0; i < means.size(); ++i) won[pipelines[i]] += means[i] == best;
  }
  return won;
}

}  // namespace

CellValues values_of(const std::vector<SummaryRow>& rows, const std::string& metric) {
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

std::vector<std::uint64_t> seeds_of(const std::vector<SummaryRow>& rows) {
  std::set<std::uint64_t> seeds;
  for (const auto& row : rows) seeds.insert(row.seed);
  return {seeds.begin(), seeds.end()};
}

double noise_m(const Scenario& scenario) {
  return std::get<SimulatedInput>(scenario.input).sensor.noise.sigma_m;
}

const std::vector<BenchmarkColumn>& benchmark_columns() {
  using enum Direction;
  static const std::vector<BenchmarkColumn> kColumns{
      {"f1", "F1 [%]", 100, 2, false, higher_is_better, "harmonic mean of precision and recall; decides the rank"},
      {"precision", "precision [%]", 100, 2, false, higher_is_better,
       "true lines over all lines found: true / (true + false + split)"},
      {"recall", "recall [%]", 100, 2, false, higher_is_better, "true lines over lines that are there"},
      {"split", "split [%]", 100, 2, false, lower_is_better, "share of the found lines that repeat a true line"},
      {"merged", "merged [%]", 100, 2, false, lower_is_better,
       "share of the found lines that cover more than half of two true lines of different walls"},
      {"overlap", "overlap [%]", 100, 2, false, higher_is_better,
       "common extent of a true line and its match over the extent of both together"},
      {"sigma_offset", "σ offset [cm]", 100, 3, false, lower_is_better,
       "root mean square distance of the matches' midpoints from the true line"},
      {"sigma_angle", "σ angle [°]", 1, 3, false, lower_is_better,
       "root mean square angle between the matches and the true line"},
      {"efficiency_offset", "offset / bound", 1, 2, true, target,
       "mean square error of the offset at the true line's midpoint over its Cramér–Rao bound; 1 is the best that the "
       "readings allow; lines with 20 returns or more",
       1.0},
      {"efficiency_angle", "angle / bound", 1, 2, true, target, "the same for the angle", 1.0},
      {"t_scan", "time [µs]", 1, 2, true, lower_is_better, "median CPU time per scan"},
      {"t_ratio", "time ratio", 1, 2, true, lower_is_better,
       "that time over the baseline's in the same condition and seed"}};
  return kColumns;
}

metrics::MetricDescription BenchmarkColumn::description() const {
  metrics::MetricDescription result;
  result.metric = metric;
  result.direction = direction;
  result.target = target;
  return result;
}

std::vector<RankedPipeline> rank_pipelines(const std::vector<Scenario>& scenarios, const std::vector<SummaryRow>& rows,
                                           const BenchmarkSpec& spec) {
  if (scenarios.empty()) return {};
  const std::vector<std::string> names = pipeline_names(scenarios.front());
  const std::vector<std::string> conditions = scenario_names(scenarios);
  const std::vector<std::uint64_t> seeds = seeds_of(rows);
  std::map<std::string, RankedPipeline> by_name;
  std::map<std::string, std::vector<double>> f1_of;
  const CellValues f1 = values_of(rows, "f1");
  const auto won = conditions_won(f1, names, seeds, conditions);
  for (const auto& column : benchmark_columns()) {
    const CellValues values = column.metric == "t_ratio" ? ratios_to(values_of(rows, "t_scan"), spec.baseline)
                                                         : values_of(rows, column.metric);
    for (const auto& name : names)
      by_name[name].values[column.metric] = mean_interval(per_seed(values, name, seeds, conditions, column.geometric));
  }
  std::vector<RankedPipeline> ranking;
  for (const auto& name : names) {
    RankedPipeline& ranked = by_name[name];
    ranked.name = name;
    ranked.conditions_won = won.at(name);
    f1_of[name] = per_seed(f1, name, seeds, conditions);
    for (const auto& condition : conditions)
      for (const std::uint64_t seed : seeds) {
        const auto found = f1.find({name, seed, condition});
        ranked.missing += found == f1.end() || !std::isfinite(found->second);
      }
    ranking.push_back(ranked);
  }
  const auto key = [](const RankedPipeline& r) {
    const double mean = r.values.at("f1").mean;
    return std::tuple(r.missing > 0, std::isfinite(mean) ? -mean : 1.0, r.name);
  };
  std::ranges::sort(ranking, {}, key);

  std::vector<double> p_values;
  for (std::size_t i = 0; i < ranking.size(); ++i) {
    std::vector<double> differences;
    if (i + 1 < ranking.size())
      std::ranges::transform(f1_of[ranking[i].name], f1_of[ranking[i + 1].name], std::back_inserter(differences),
                             std::minus<>{});
    ranking[i].next_difference = average(differences, false);
    p_values.push_back(paired_p_value(differences));
  }
  const std::vector<double> adjusted = holm_adjusted(p_values);
  for (std::size_t i = 0; i < ranking.size(); ++i) ranking[i].next_p = adjusted[i];
  return ranking;
}

}  // namespace scanbench::harness
