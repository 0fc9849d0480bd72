// Finds the leaders of a benchmark and the factor that changes most which pipeline leads.
#include "harness/results/analysis/benchmark_finding.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/index.hpp"
#include "harness/results/analysis/shared_best.hpp"

namespace scanbench::results {
namespace {

using Levels = std::vector<LevelResult>;

bool contains(const std::vector<int>& indices, int index) {
  return std::ranges::find(indices, index) != indices.end();
}

/// Whether a leader of each of the two levels is not among the leaders of the other.
bool leaders_change(const LevelResult& a, const LevelResult& b) {
  return !a.leaders.empty() && !b.leaders.empty() && !contains(b.leaders, a.leaders.front()) &&
         !contains(a.leaders, b.leaders.front());
}

bool leaders_change(const Levels& levels) {
  for (std::size_t i = 0; i < levels.size(); ++i)
    for (std::size_t j = i + 1; j < levels.size(); ++j)
      if (leaders_change(levels[i], levels[j])) return true;
  return false;
}

/// Pipelines that lead at a level and have values at all of them.
std::vector<int> contenders(const Levels& all) {
  std::set<int> leading;
  for (const auto& level : all) leading.insert(level.leaders.begin(), level.leaders.end());
  std::vector<int> complete;
  std::ranges::copy_if(leading, std::back_inserter(complete), [&](int pipeline) {
    return std::ranges::all_of(
        all, [&](const LevelResult& level) { return std::isfinite(level.values[as_index(pipeline)].mean); });
  });
  return complete;
}

/// Mean square of the interaction of pipelines and levels: of x_pl - x_p. - x_.l + x_..
double interaction(const Levels& levels, const std::vector<int>& pipelines, bool geometric) {
  const auto value = [&](int pipeline, const LevelResult& level) {
    const double mean = level.values[as_index(pipeline)].mean;
    return geometric ? std::log(mean) : mean;
  };
  const auto rows = static_cast<double>(pipelines.size());
  const auto columns = static_cast<double>(levels.size());
  std::map<int, double> of_pipeline;
  std::vector<double> of_level;
  double of_all = 0.0;
  for (const auto& level : levels) {
    double sum = 0.0;
    for (const int p : pipelines) {
      sum += value(p, level);
      of_pipeline[p] += value(p, level) / columns;
    }
    of_level.push_back(sum / rows);
    of_all += sum / (rows * columns);
  }
  double squares = 0.0;
  for (std::size_t l = 0; l < levels.size(); ++l)
    for (const int p : pipelines) {
      const double effect = value(p, levels[l]) - of_pipeline[p] - of_level[l] + of_all;
      squares += effect * effect;
    }
  return squares / (rows * columns);
}

std::vector<std::string> overall_leaders(const study::BenchmarkSpec& spec, const std::vector<RankedPipeline>& ranking) {
  const study::BenchmarkColumn& rank = spec.subject().rank_column();
  std::vector<std::vector<double>> by_seed;
  std::vector<bool> complete;
  for (const auto& ranked : ranking) {
    by_seed.push_back(ranked.by_seed.at(rank.metric));
    complete.push_back(ranked.missing == 0);
  }
  std::vector<std::string> leaders;
  for (const int i : shared_best(by_seed, rank.description(), complete)) leaders.push_back(ranking[as_index(i)].name);
  return leaders;
}

}  // namespace

BenchmarkFinding find_leaders(const std::vector<study::Scenario>& scenarios, const std::vector<runs::SummaryRow>& rows,
                              const study::BenchmarkSpec& spec, const std::vector<RankedPipeline>& ranking) {
  if (std::ssize(seeds_of(rows)) < kFewestSeedsToSeparate) return {};
  BenchmarkFinding finding{overall_leaders(spec, ranking), "", {}};
  std::vector<std::string> names;
  for (const auto& ranked : ranking) names.push_back(ranked.name);
  finding.levels = results_by_level(scenarios, rows, spec, names);
  const std::vector<int> pipelines = contenders(finding.levels);
  std::map<std::string, Levels> by_factor;
  for (const auto& level : finding.levels) by_factor[level.factor].push_back(level);
  double largest = 0.0;
  for (const auto& [factor, levels] : by_factor) {
    const double size = interaction(levels, pipelines, spec.subject().rank_column().geometric);
    if (!leaders_change(levels) || !(size > largest)) continue;
    largest = size;
    finding.factor = factor;
  }
  if (!finding.factor.empty()) finding.levels = by_factor.at(finding.factor);
  return finding;
}

}  // namespace scanbench::results
