// Reading what is asked for; averages over conditions and seeds; ranks and tests.
#include "harness/benchmark.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/atomic_file.hpp"
#include "harness/pipeline.hpp"
#include "harness/scenario_reader.hpp"
#include "harness/yaml_reader.hpp"

namespace scanbench::harness {
namespace {

namespace fs = std::filesystem;
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

void check_metrics(const Scenario& scenario, const BenchmarkSubject& subject, YamlMark mark) {
  std::string allowed;
  for (const auto& [family, parameter] : subject.required)
    allowed += (allowed.empty() ? "" : ", ") +
               (parameter.empty() ? family : fmt::format("{{name: {}, params: {{{}: true}}}}", family, parameter));
  for (const auto& [family, parameter] : subject.required) {
    const auto choice = std::ranges::find(scenario.metrics, family, &ModuleChoice::module);
    const bool fits =
        choice != scenario.metrics.end() && (parameter.empty() || std::get<bool>(choice->params.at(parameter)));
    if (!fits)
      throw PlacedError(mark,
                        fmt::format("{} has no metric {}{}; allowed: a benchmark of scenarios with the metrics {}",
                                    scenario.name, family, parameter.empty() ? "" : " with " + parameter, allowed));
  }
}

void check_slots(const Scenario& scenario, const std::string& slot, YamlMark mark) {
  for (const auto& pipeline : scenario.pipelines)
    if (!has_slot(pipeline, slot))
      throw PlacedError(mark, fmt::format("{} of {} has no slot {}; allowed: a benchmark of pipelines that have it",
                                          pipeline.name, scenario.name, slot));
}

/// Each value over the baseline's in the same scenario and seed.
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

bool better(double a, double b, Direction direction) {
  return direction == Direction::lower_is_better ? a < b : a > b;
}

std::map<std::string, int> conditions_won(const CellValues& rank, const BenchmarkColumn& column,
                                          const std::vector<std::string>& pipelines,
                                          const std::vector<std::uint64_t>& seeds,
                                          const std::vector<std::string>& scenarios) {
  std::map<std::string, int> won;
  for (const auto& scenario : scenarios) {
    std::vector<double> means;
    for (const auto& pipeline : pipelines)
      means.push_back(average(per_seed(rank, pipeline, seeds, {scenario}), column.geometric));
    double best = kNan;
    for (const double m : means)
      if (std::isnan(best) || better(m, best, column.direction)) best = m;
    for (std::size_t i = 0; i < means.size(); ++i) won[pipelines[i]] += means[i] == best;
  }
  return won;
}

std::string number(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "–";
}

/// Fewer decimals for larger values where a column spans decades.
TableCell interval_cell(const Interval& interval, const BenchmarkColumn& column) {
  if (!std::isfinite(interval.mean)) return {"–"};
  const double mean = interval.mean * column.scale;
  const int large = column.geometric ? static_cast<int>(mean >= 10) + static_cast<int>(mean >= 100) : 0;
  const int decimals = std::max(0, column.decimals - large);
  TableCell cell{number(mean, decimals)};
  if (interval.count > 1) cell.spread = "± " + number(interval.half_width() * column.scale, decimals);
  return cell;
}

TableCell next_cell(const RankedPipeline& ranked, const BenchmarkColumn& column) {
  if (!std::isfinite(ranked.next_p)) return {"–"};
  TableCell cell{column.geometric ? fmt::format("× {:.3f}", std::exp(ranked.next_difference))
                                  : fmt::format("{:+.2f}", column.scale * ranked.next_difference)};
  cell.spread = ranked.next_p < 0.001 ? "p < 0.001" : fmt::format("p = {:.3f}", ranked.next_p);
  if (ranked.next_p >= 0.05) cell.spread += " n.s.";
  return cell;
}

}  // namespace

std::string next_head(const BenchmarkColumn& rank) {
  const std::string name = rank.head.substr(0, rank.head.find(" ["));
  return rank.geometric ? name + " over next" : name + " − next";
}

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

BenchmarkSpec read_benchmark(const YamlNode& node, const std::vector<Scenario>& scenarios) {
  YamlMap map(node, "benchmark");
  BenchmarkSpec spec;
  const YamlNode* of = map.find("of");
  spec.of = map.text_or("of", spec.of);
  if (const auto slots = benchmark_slots(); std::ranges::find(slots, spec.of) == slots.end())
    throw PlacedError(of->mark,
                      fmt::format("no benchmark ranks modules of the kind {}{}", spec.of, known_names(spec.of, slots)));
  const YamlNode& baseline = map.require("baseline", "a pipeline's name");
  spec.baseline = map.text("baseline", "a pipeline's name");
  spec.example = map.text_or("example", scenarios.front().name);
  const YamlNode* example = map.find("example");
  map.done();
  const std::vector<std::string> pipelines = pipeline_names(scenarios.front());
  for (const auto& scenario : scenarios) {
    if (pipeline_names(scenario) != pipelines)
      throw PlacedError(node.mark,
                        fmt::format("{} and {} have different pipelines; allowed: a benchmark of scenarios with "
                                    "the same ones",
                                    scenarios.front().name, scenario.name));
    if (!std::holds_alternative<SimulatedInput>(scenario.input))
      throw PlacedError(node.mark,
                        fmt::format("{} is not simulated; allowed: scenarios with a world, a sensor and a trajectory",
                                    scenario.name));
    check_slots(scenario, spec.of, node.mark);
    check_metrics(scenario, spec.subject(), node.mark);
  }
  if (std::ranges::find(pipelines, spec.baseline) == pipelines.end())
    throw PlacedError(baseline.mark,
                      fmt::format("no pipeline is called {}{}", spec.baseline, known_names(spec.baseline, pipelines)));
  const std::vector<std::string> names = scenario_names(scenarios);
  if (std::ranges::find(names, spec.example) == names.end())
    throw PlacedError(example->mark,
                      fmt::format("no scenario is called {}{}", spec.example, known_names(spec.example, names)));
  return spec;
}

std::string benchmark_json(const BenchmarkSpec& spec) {
  const nlohmann::ordered_json json{
      {"about", spec.about}, {"of", spec.of}, {"baseline", spec.baseline}, {"example", spec.example}};
  return json.dump(2) + "\n";
}

std::optional<BenchmarkSpec> load_benchmark(const fs::path& run) {
  const fs::path path = run / "benchmark.json";
  if (!fs::exists(path)) return std::nullopt;
  try {
    const auto json = nlohmann::json::parse(read_file(path));
    return BenchmarkSpec{json.at("about"), json.at("baseline"), json.at("example"), json.value("of", "extract")};
  } catch (const nlohmann::json::exception& error) {
    throw ConfigError(path.string() + ": " + error.what());
  }
}

std::vector<RankedPipeline> rank_pipelines(const std::vector<Scenario>& scenarios, const std::vector<SummaryRow>& rows,
                                           const BenchmarkSpec& spec) {
  if (scenarios.empty()) return {};
  const std::vector<std::string> names = pipeline_names(scenarios.front());
  const std::vector<std::string> conditions = scenario_names(scenarios);
  const std::vector<std::uint64_t> seeds = seeds_of(rows);
  std::map<std::string, RankedPipeline> by_name;
  std::map<std::string, std::vector<double>> rank_of;
  const BenchmarkSubject& subject = spec.subject();
  const BenchmarkColumn& rank = subject.rank_column();
  const CellValues rank_values = values_of(rows, rank.metric);
  const auto won = conditions_won(rank_values, rank, names, seeds, conditions);
  for (const auto& column : subject.columns) {
    const CellValues values = column.metric == "t_ratio"
                                  ? ratios_to(values_of(rows, subject.time_metric), spec.baseline)
                                  : values_of(rows, column.metric);
    for (const auto& name : names)
      by_name[name].values[column.metric] = mean_interval(per_seed(values, name, seeds, conditions, column.geometric));
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
        ranked.missing += found == rank_values.end() || !std::isfinite(found->second);
      }
    ranking.push_back(ranked);
  }
  const auto key = [&](const RankedPipeline& r) {
    const double mean = r.values.at(rank.metric).mean;
    const double sign = rank.direction == Direction::lower_is_better ? 1.0 : -1.0;
    return std::tuple(r.missing > 0, !std::isfinite(mean), std::isfinite(mean) ? sign * mean : 0.0, r.name);
  };
  std::ranges::sort(ranking, {}, key);

  std::vector<double> p_values;
  for (std::size_t i = 0; i < ranking.size(); ++i) {
    std::vector<double> differences;
    if (i + 1 < ranking.size())
      std::ranges::transform(rank_of[ranking[i].name], rank_of[ranking[i + 1].name], std::back_inserter(differences),
                             std::minus<>{});
    ranking[i].next_difference = average(differences, false);
    p_values.push_back(paired_p_value(differences));
  }
  const std::vector<double> adjusted = holm_adjusted(p_values);
  for (std::size_t i = 0; i < ranking.size(); ++i) ranking[i].next_p = adjusted[i];
  return ranking;
}

Table ranking_table(const std::vector<RankedPipeline>& ranking, const BenchmarkSpec& spec) {
  Table table{"ranking", "", "", {"", spec.subject().noun}, {}, {}};
  const auto& columns = spec.subject().columns;
  for (const auto& column : columns)
    table.columns.push_back({"", column.metric == "t_ratio" ? "time / " + spec.baseline : column.head, false});
  table.columns.push_back({"", next_head(spec.subject().rank_column()), false});
  table.columns.push_back({"", "best in", false});
  int rank = 0;
  for (const auto& ranked : ranking) {
    const std::string missing = ranked.missing > 0 ? fmt::format(" ({} cells missing)", ranked.missing) : "";
    Table::Row row{{std::to_string(++rank), ranked.name + missing}, {}, false};
    for (const auto& column : columns) row.cells.push_back(interval_cell(ranked.values.at(column.metric), column));
    row.cells.push_back(next_cell(ranked, columns.front()));
    row.cells.push_back({std::to_string(ranked.conditions_won)});
    table.rows.push_back(std::move(row));
  }
  std::size_t c = 0;
  for (const auto& column : columns) {
    if (column.direction == Direction::neither) {
      ++c;
      continue;
    }
    double best = kNan;
    for (const auto& ranked : ranking) {
      const double v = ranked.values.at(column.metric).mean;
      if (std::isnan(best) || better(v, best, column.direction)) best = v;
    }
    for (std::size_t r = 0; r < ranking.size(); ++r)
      table.rows[r].cells[c].best = ranking[r].values.at(column.metric).mean == best;
    ++c;
  }
  return table;
}

}  // namespace scanbench::harness
