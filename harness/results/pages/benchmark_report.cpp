// Builds the page of a benchmark over all of its scenarios.
#include "harness/results/pages/benchmark_report.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/geometry/geometry.hpp"
#include "core/index.hpp"
#include "harness/results/analysis/benchmark_finding.hpp"
#include "harness/results/figures/recording_note.hpp"
#include "harness/results/pages/benchmark_extremes.hpp"
#include "harness/results/pages/page_parts.hpp"
#include "harness/results/pages/run_links.hpp"
#include "harness/results/tables/level_table.hpp"
#include "harness/results/tables/ranking_table.hpp"
#include "harness/results/tables/table_marks.hpp"
#include "harness/runs/store/summary.hpp"
#include "harness/study/catalog/chain.hpp"
#include "harness/study/catalog/find_module.hpp"
#include "harness/study/scenario/benchmark_spec.hpp"
#include "harness/study/scenario/simulation_input.hpp"

namespace scanbench::results {
namespace {

const study::SimulatedInput& simulated(const study::Scenario& scenario) {
  return std::get<study::SimulatedInput>(scenario.input);
}

std::set<double> noise_levels(const std::vector<study::Scenario>& scenarios) {
  std::set<double> levels;
  for (const auto& scenario : scenarios) levels.insert(100.0 * noise_m(scenario));
  return levels;
}

/// Observations of a metric of one pipeline, over all cells.
std::int64_t observations(const std::vector<runs::SummaryRow>& rows, const std::string& pipeline,
                          const std::string& metric) {
  std::int64_t count = 0;
  for (const auto& row : rows)
    if (row.pipeline == pipeline && row.metric == metric) count += row.count;
  return count;
}

std::string with_count(std::size_t count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string run_text(const ReportInput& input, const study::BenchmarkSpec& spec) {
  std::set<std::string> worlds, sensors;
  for (const auto& scenario : input.scenarios) {
    worlds.insert(simulated(scenario).world.name);
    sensors.insert(simulated(scenario).sensor_preset);
  }
  const auto& scenarios = input.scenarios;
  const study::BenchmarkSubject& subject = spec.subject();
  const std::size_t seeds = seeds_of(input.rows).size();
  const std::string counted =
      subject.counted.empty()
          ? ""
          : fmt::format(" and {} {}", observations(input.rows, spec.baseline, subject.count_metric), subject.counted);
  return fmt::format(
      "{} {}s on {} conditions: {} world{}, {} sensor{}, noise of {:.3g} cm. {} {} {} recordings with "
      "{} scans{} in total; every {} gets the same recordings.",
      scenarios.front().pipelines.size(), subject.noun, scenarios.size(), worlds.size(), worlds.size() == 1 ? "" : "s",
      sensors.size(), sensors.size() == 1 ? "" : "s", fmt::join(noise_levels(scenarios), " and "),
      with_count(seeds, "seed"), seeds == 1 ? "makes" : "make", scenarios.size() * seeds,
      observations(input.rows, spec.baseline, "t_scan"), counted, subject.noun);
}

Table worlds_table(const ReportInput& input) {
  Table table{"worlds", "Worlds", "", {"world", "what it is"}, {{"", "walls"}, {"", "scans per recording"}}, {}};
  std::map<std::string, std::set<std::size_t>> scans;
  for (const auto& scenario : input.scenarios)
    scans[simulated(scenario).world.name].insert(
        study::simulation_input(scenario, scenario.seeds.front()).trajectory.poses.size());
  std::set<std::string> seen;
  for (const auto& scenario : input.scenarios) {
    const auto& world = simulated(scenario).world;
    if (!seen.insert(world.name).second) continue;
    table.rows.push_back(
        {{world.name, scenario.about},
         {{std::to_string(world.walls.size())}, {fmt::format("{}", fmt::join(scans[world.name], ", "))}},
         false});
  }
  return table;
}

Table sensors_table(const ReportInput& input) {
  Table table{"sensors",
              "Sensors",
              "",
              {"sensor"},
              {{"", "beams"}, {"", "step [°]"}, {"", "field of view [°]"}, {"", "range [m]"}},
              {}};
  std::set<std::string> seen;
  for (const auto& scenario : input.scenarios) {
    const auto& [preset, sensor] = std::tie(simulated(scenario).sensor_preset, simulated(scenario).sensor);
    if (!seen.insert(preset).second) continue;
    const double step = degrees(sensor.geometry.angle_step());
    table.rows.push_back({{preset},
                          {{std::to_string(sensor.geometry.beams())},
                           {fmt::format("{:.3g}", step)},
                           {fmt::format("{:.0f}", step * (sensor.geometry.beams() - 1))},
                           {fmt::format("{:.3g} – {:.3g}", sensor.range_min_m, sensor.range_max_m)}},
                          false});
  }
  return table;
}

const study::ModuleChoice& slot_of(const study::PipelineSpec& pipeline, const std::string& kind) {
  return *std::ranges::find(pipeline.slots, kind, &study::ModuleChoice::kind);
}

/// "threshold_m 0.04 / 0.12 / 0.2", one value per noise level if they differ; empty if all have the default.
std::string param_text(const std::vector<study::Scenario>& scenarios, std::size_t pipeline, const std::string& slot,
                       const std::string& name, const std::string& default_text) {
  std::map<double, std::set<std::string>> by_noise;
  std::set<std::string> all;
  for (const auto& scenario : scenarios) {
    const std::string value = to_text(slot_of(scenario.pipelines[pipeline], slot).params.at(name));
    by_noise[noise_m(scenario)].insert(value);
    all.insert(value);
  }
  if (all.size() == 1) return *all.begin() == default_text ? "" : name + " " + *all.begin();
  std::vector<std::string> values;
  for (const auto& [noise, of_noise] : by_noise) {
    if (of_noise.size() > 1) return name + " differs, see effective/";
    values.push_back(*of_noise.begin());
  }
  return fmt::format("{} {}", name, fmt::join(values, " / "));
}

/// The parameters of a pipeline's module that differ from the defaults. A run folder does not keep the defaults of a
/// foreign module: all of its parameters, after "all: ".
std::string params_text(const std::vector<study::Scenario>& scenarios, std::size_t pipeline, const std::string& slot,
                        const std::vector<ParamSpec>& specs) {
  std::vector<std::string> params;
  const auto append = [&](const std::string& name, const std::string& default_text) {
    if (auto text = param_text(scenarios, pipeline, slot, name, default_text); !text.empty())
      params.push_back(std::move(text));
  };
  for (const auto& spec : specs) append(spec.name, to_text(spec.default_value));
  const study::ModuleChoice& choice = slot_of(scenarios.front().pipelines[pipeline], slot);
  const bool unknown = choice.source && specs.empty() && !choice.params.empty();
  if (unknown)
    for (const auto& [name, value] : choice.params) append(name, "no default is known");
  return fmt::format("{}{}", unknown ? "all: " : "", fmt::join(params, ", "));
}

/// "split_and_merge (min_points 9)": a module that is not ranked, with its parameters other than the defaults.
std::string other_module(const std::vector<study::Scenario>& scenarios, std::size_t pipeline,
                         const study::ModuleChoice& slot) {
  const bool same = std::ranges::all_of(scenarios, [&](const study::Scenario& scenario) {
    const study::PipelineSpec& other = scenario.pipelines[pipeline];
    return study::has_slot(other, slot.kind) && slot_of(other, slot.kind).module == slot.module;
  });
  if (!same) return "differs, see effective/";
  const std::string params = params_text(scenarios, pipeline, slot.kind, study::entry_of(slot).params);
  return slot.module + (params.empty() ? "" : " (" + params + ")");
}

Table modules_table(const ReportInput& input, const study::BenchmarkSpec& spec) {
  const auto& scenarios = input.scenarios;
  const std::string& noun = spec.subject().noun;
  std::string title = noun + "s";
  title.front() = static_cast<char>(title.front() - 'a' + 'A');
  Table table{noun + "s", title, "", {noun, "what it does", "parameters other than the defaults"}, {}, {}};
  std::vector<std::string> others;
  for (const study::ModuleChoice& slot : scenarios.front().pipelines.front().slots)
    if (slot.kind != spec.of) others.push_back(slot.kind);
  for (const auto& kind : others) table.row_heads.push_back(kind);
  bool by_noise = false;
  for (const auto& ranked : input.ranking) {
    const auto& pipelines = scenarios.front().pipelines;
    const auto k = static_cast<std::size_t>(std::ranges::find(pipelines, ranked.name, &study::PipelineSpec::name) -
                                            pipelines.begin());
    const study::ModuleEntry module = study::entry_of(slot_of(pipelines[k], spec.of));
    const study::ModuleChoice& slot = slot_of(pipelines[k], spec.of);
    const std::string version = slot.source ? slot.source->module.version : "";
    const std::string what = version.empty() ? module.info.summary : module.info.summary + ", version " + version;
    std::vector<std::string> heads{ranked.name, what, params_text(scenarios, k, spec.of, module.params)};
    for (const auto& kind : others)
      heads.push_back(study::has_slot(pipelines[k], kind) ? other_module(scenarios, k, slot_of(pipelines[k], kind))
                                                          : "");
    for (std::size_t h = 2; h < heads.size(); ++h) by_noise = by_noise || heads[h].find(" / ") != std::string::npos;
    table.rows.push_back({heads, {}, false});
  }
  if (by_noise)
    table.caption = fmt::format("Values separated by / belong to the noise levels {:.3g} cm.",
                                fmt::join(noise_levels(scenarios), " / "));
  return table;
}

/// How far a pipeline is from the best possible: "The mean square error of icp's poses is 1.49 times the bound"; empty
/// without the value.
std::string bound_text(const RankedPipeline& ranked, const study::BenchmarkSubject& subject) {
  const double ratio = ranked.values.at(subject.bound.metric).mean;
  if (!std::isfinite(ratio)) return "";
  return fmt::format(" The mean square error of {}'s {} is {:.3g} times the Cramér–Rao bound, the best possible.",
                     ranked.name, subject.bound.of, ratio);
}

/// A value of the column that decides the rank: "95.20 %".
std::string rank_text(const study::BenchmarkColumn& rank, double value) {
  return fmt::format("{:.{}f}{}", rank.scale * value, rank.decimals, rank.is_share() ? " %" : "");
}

/// "95.20 % (95.01 to 95.39)"
std::string rank_text(const study::BenchmarkColumn& rank, const MeanInterval& value) {
  return fmt::format("{} ({:.{}f} to {:.{}f})", rank_text(rank, value.mean), rank.scale * value.low, rank.decimals,
                     rank.scale * value.high, rank.decimals);
}

/// "a, b and c", "a, b, c and 4 more".
std::string and_list(const std::vector<std::string>& names) {
  constexpr std::size_t kListed = 4;
  if (names.size() > kListed)
    return fmt::format("{} and {} more", fmt::join(names.begin(), names.begin() + kListed - 1, ", "),
                       names.size() - kListed + 1);
  return fmt::format("{} and {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

/// Which pipelines lead: the page's first sentence, and how far the first is from the best possible.
std::string answer_text(const ReportInput& input, const study::BenchmarkSpec& spec, const BenchmarkFinding& finding) {
  const study::BenchmarkSubject& subject = spec.subject();
  const study::BenchmarkColumn& rank = subject.rank_column();
  const RankedPipeline& first = input.ranking.front();
  const auto value = [&](const RankedPipeline& ranked) { return rank_text(rank, ranked.values.at(rank.metric).mean); };
  if (first.missing > 0 || !std::isfinite(first.values.at(rank.metric).mean))
    return fmt::format("No {} has a result in every cell, so the ranking has no winner.", subject.noun);
  const std::size_t seeds = seeds_of(input.rows).size();
  if (seeds < kFewestSeedsToSeparate)
    return fmt::format("{} too few to say which of {} {}s is best (at least {}); {} has the best {} on {}, {}.{}",
                       with_count(seeds, "seed") + (seeds == 1 ? " is" : " are"), input.ranking.size(), subject.noun,
                       kFewestSeedsToSeparate, first.name, rank.name(), seeds == 1 ? "it" : "them", value(first),
                       bound_text(first, subject));
  if (finding.leaders.size() > 1) {
    const auto last = std::ranges::find(input.ranking, finding.leaders.back(), &RankedPipeline::name);
    return fmt::format("{} share the best {} of {} {}s, {} to {}: {} seeds do not separate them.{}",
                       and_list(finding.leaders), rank.name(), input.ranking.size(), subject.noun, value(first),
                       value(*last), seeds, bound_text(first, subject));
  }
  std::string text = fmt::format("{} has the best {} of {} {}s, {}", first.name, rank.name(), input.ranking.size(),
                                 subject.noun, value(first));
  if (seeds < kFewestForInterval) text += fmt::format(", and is ahead on each of {} seeds", seeds);
  if (input.ranking.size() > 1 && input.ranking[1].missing > 0)
    text += fmt::format("; {} has no result in {} cells", input.ranking[1].name, input.ranking[1].missing);
  else if (input.ranking.size() > 1)
    text += fmt::format("; {} is next with {}", input.ranking[1].name, value(input.ranking[1]));
  return text + "." + bound_text(first, subject);
}

/// The factor that changes which pipeline leads, with the leaders of its levels; empty without factors.
std::string split_text(const std::vector<RankedPipeline>& ranking, const study::BenchmarkSpec& spec,
                       const BenchmarkFinding& finding) {
  if (finding.leaders.empty() || finding.levels.empty()) return "";
  const study::BenchmarkColumn& rank = spec.subject().rank_column();
  if (finding.factor.empty()) return "No factor of the suite changes which is best.";
  std::vector<std::string> levels;
  for (const auto& level : finding.levels) {
    if (level.leaders.empty()) continue;
    const std::size_t best = as_index(level.leaders.front());
    const std::size_t others = level.leaders.size() - 1;
    levels.push_back(fmt::format("{}: {} with {}{}", level.level, ranking[best].name,
                                 rank_text(rank, level.values[best]),
                                 others == 0 ? "" : fmt::format(", not separated from {} more", others)));
  }
  return fmt::format("Which is best depends most on the {}. {}.", finding.factor, fmt::join(levels, "; "));
}

/// What stands below the values, and the neighbours in the ranking that the seeds do not separate.
std::string interval_text(const std::vector<RankedPipeline>& ranking) {
  if (ranking.front().values.begin()->second.count < kFewestForInterval)
    return fmt::format(
        "Below a value: the smallest and the largest one of the seeds. Fewer than {} seeds have no intervals.",
        kFewestForInterval);
  std::vector<std::string> together;
  for (std::size_t i = 0; i + 1 < ranking.size(); ++i)
    if (ranking[i].next.low <= 0.0 && 0.0 <= ranking[i].next.high)
      together.push_back(ranking[i].name + " and " + ranking[i + 1].name);
  const std::string below = "Below a value: its 95 % interval. ";
  return below + (together.empty() ? "The seeds separate all neighbours in rank."
                                   : fmt::format("The seeds do not separate these neighbours in rank: {}.",
                                                 fmt::join(together, "; ")));
}

Definitions column_definitions(const study::BenchmarkSpec& spec) {
  Definitions all;
  const study::BenchmarkColumn& rank = spec.subject().rank_column();
  for (const auto& column : spec.subject().columns) {
    std::string text = column.definition;
    if (column.geometric) text += "; geometric mean over the conditions";
    all.items.emplace_back(column.metric == "t_ratio" ? "time / " + spec.baseline : column.head, text);
  }
  all.items.emplace_back(next_head(rank),
                         rank.geometric ? "mean ratio of the first column to that of the next in rank, paired by seed"
                                        : "mean difference of the first column to the next in rank, paired by seed");
  all.items.emplace_back("best in", "conditions in which its first column is the best; ties count for all");
  return all;
}

std::vector<std::string> names_of(const std::vector<RankedPipeline>& ranking) {
  std::vector<std::string> names;
  names.reserve(ranking.size());
  for (const auto& ranked : ranking) names.push_back(ranked.name);
  return names;
}

/// The table by levels and its sentence; empty if the suite has no factors.
Blocks level_blocks(const ReportInput& input, const study::BenchmarkSpec& spec) {
  const auto names = names_of(input.ranking);
  const auto results = results_by_level(input.scenarios, input.rows, spec, names);
  if (results.empty()) return {};
  return {Heading{2, "Which is best under which condition"}, Paragraph{best_by_level_text(results, names, spec)},
          BlockGroup{"compact plain", {level_table(results, names, spec)}}};
}

std::vector<std::pair<std::string, std::string>> numbered_figures(const study::BenchmarkSpec& spec) {
  if (!spec.subject().over_start.empty()) return {{"benchmark_basin", "Figure 1"}};
  if (!spec.subject().shows_example)
    return {{"benchmark_" + spec.subject().rank_column().metric + "_noise", "Figure 1"},
            {"benchmark_error_bound", "Figure 2"}};
  return {{"benchmark_f1_noise", "Figure 1"},
          {"benchmark_offset_range", "Figure 2a"},
          {"benchmark_angle_range", "Figure 2b"},
          {"benchmark_error_bound", "Figure 3"},
          {spec.example + "_scan_overlay", "Figure 4"}};
}

Blocks ranking_section(const ReportInput& input, const study::BenchmarkSpec& spec) {
  Blocks blocks{BlockGroup{"compact ranks", {ranking_table(input.ranking, spec)}}, Paragraph{kArrowKey, "caption"},
                Paragraph{interval_text(input.ranking)}};
  add_blocks(blocks, level_blocks(input, spec));
  return blocks;
}

Blocks figure_section(const ReportInput& input, const study::BenchmarkSpec& spec) {
  BlockGroup figures{"beside", {}};
  for (const auto& [name, number] : numbered_figures(spec))
    if (const auto figure = std::ranges::find(input.figures, name, &FigureFile::name); figure != input.figures.end())
      figures.blocks.push_back(run_picture(input.run, *figure, number));
  return {std::move(figures)};
}

Blocks run_section(const ReportInput& input, const study::BenchmarkSpec& spec) {
  Blocks blocks{Paragraph{run_text(input, spec)},
                BlockGroup{"figures compact plain", {worlds_table(input), sensors_table(input)}}};
  add_blocks(blocks, remark_blocks(input.cells));
  return blocks;
}

}  // namespace

Document benchmark_document(const ReportInput& input) {
  const study::BenchmarkSpec& spec = input.benchmark.value();
  const BenchmarkFinding finding = find_leaders(input.scenarios, input.rows, spec, input.ranking);
  const std::string& noun = spec.subject().noun;
  Document page{.title = fmt::format("Benchmark of {}", with_count(input.ranking.size(), noun)),
                .blocks = {},
                .lead = answer_text(input, spec, finding),
                .stamp = stamp_of(input.facts, seeds_of(input.rows))};
  if (const std::string split = split_text(input.ranking, spec, finding); !split.empty())
    page.blocks.push_back(Paragraph{split});
  add_blocks(page.blocks, status_blocks(input.cells));
  if (!spec.about.empty()) page.blocks.push_back(Paragraph{spec.about});
  const study::BenchmarkColumn& rank = spec.subject().rank_column();
  BulletList limits;
  for (const auto& limit : spec.subject().limits) limits.items.emplace_back(limit);
  for (const auto& scenario : input.scenarios)
    if (const std::string note = bound_note(scenario); !note.empty())
      limits.items.emplace_back(scenario.name + ": " + note);
  add_blocks(page.blocks, section_blocks({{"ranking-section", "Ranking", ranking_section(input, spec)},
                                          {"time-section", rank.name() + " against time", accuracy_blocks(input)},
                                          {"figures-section", "Figures", figure_section(input, spec)},
                                          {"worst-section", "Where each does worst", worst_blocks(input)},
                                          {"run-section", "What was run", run_section(input, spec)},
                                          {"columns-section",
                                           "How the columns are defined",
                                           {Paragraph{spec.subject().method}, column_definitions(spec),
                                            BlockGroup{"prose plain", {modules_table(input, spec)}}}},
                                          {"limits-section", "What it does not show", {limits}},
                                          {"files", "Files", file_blocks(input.run, input.cells)}},
                                         input.facts));
  return page;
}

}  // namespace scanbench::results
