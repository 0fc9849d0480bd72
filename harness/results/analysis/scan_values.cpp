// Evaluates metric families on single scans of a recording.
#include "harness/results/analysis/scan_values.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/recording.hpp"
#include "core/registry.hpp"
#include "core/result.hpp"
#include "core/special_values.hpp"
#include "harness/runs/store/cell_files.hpp"
#include "harness/runs/store/recording_folder.hpp"
#include "harness/runs/store/run_scenarios.hpp"
#include "harness/study/scenario/scenario.hpp"
#include "metrics/metric.hpp"

namespace scanbench::results {
namespace fs = std::filesystem;
namespace {

using metrics::MetricFamily;
using metrics::MetricRow;

constexpr double kSameMean = 1e-9;  // relative: the order of a sum differs
constexpr const char* kOfScans = "scans";
constexpr const char* kOfPairs = "pairs of scans";

/// The rows of "all", by metric, of some of the scans or relations; empty where the family does not apply.
using Rows = std::map<std::string, MetricRow>;

Rows rows_of(const MetricFamily& family, const ScanSet& observed, const Truth* truth, const PipelineResult& result,
             const ReferencePoses* reference) {
  const metrics::MetricInput input{observed, truth, result, reference};
  Rows rows;
  if (!family.applies(input)) return rows;
  for (auto& row : family.evaluate(input))
    if (row.subject == "all") rows.emplace(row.metric, std::move(row));
  return rows;
}

/// The matches among some neighbouring frames, which are numbered from the first of them.
std::vector<FrameMatch> matches_among(const std::vector<FrameMatch>& all, std::size_t first, std::size_t count) {
  const auto begin = static_cast<int>(first), end = static_cast<int>(first + count);
  const auto among = [&](int frame) { return frame >= begin && frame < end; };
  std::vector<FrameMatch> matches;
  for (const FrameMatch& match : all)
    if (among(match.frame) && among(match.reference))
      matches.push_back({match.frame - begin, match.reference - begin, match.match});
  return matches;
}

/// Some neighbouring frames of a recording with the lines, matches and poses found in them.
Rows of_frames(const MetricFamily& family, const Recording& recording, const PipelineResult& result, std::size_t first,
               std::size_t count) {
  const auto rows_from = [&](const auto& all, std::size_t per_frame) {  // a row of a table per frame
    using List = std::decay_t<decltype(all)>;
    if (all.size() != recording.observed.frames.size() * per_frame) return List{};
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first * per_frame);
    return List(begin, begin + static_cast<std::ptrdiff_t>(count * per_frame));
  };
  const auto part = [&](const auto& all) { return rows_from(all, 1); };
  const ScanSet observed{recording.observed.sensor, part(recording.observed.frames)};
  PipelineResult found;
  found.lines = part(result.lines);
  found.world_from_sensor = part(result.world_from_sensor);
  found.matches = matches_among(result.matches, first, count);
  found.has_map = result.has_map;
  found.map = result.map;
  if (recording.truth) {
    const auto beams = static_cast<std::size_t>(recording.observed.sensor.geometry.beams());
    const Truth truth{recording.truth->walls, part(recording.truth->world_from_sensor),
                      rows_from(recording.truth->ranges, beams), rows_from(recording.truth->wall_ids, beams)};
    return rows_of(family, observed, &truth, found, nullptr);
  }
  if (!recording.reference) return rows_of(family, observed, nullptr, found, nullptr);
  const ReferencePoses reference{part(recording.reference->world_from_sensor), {}};
  return rows_of(family, observed, nullptr, found, &reference);
}

/// The metric on every scan alone, NaN where it is not defined; nullopt unless it depends on nothing but the lines of
/// the scans: without poses, matches and map it must have the same value.
std::optional<std::vector<double>> of_single_frames(const MetricFamily& family, const Recording& recording,
                                                    const PipelineResult& result, const std::string& metric) {
  const auto value_of = [&](const PipelineResult& found, std::size_t first, std::size_t count) {
    const Rows rows = of_frames(family, recording, found, first, count);
    const auto row = rows.find(metric);
    return row == rows.end() ? kNaN : row->second.value;
  };
  const std::size_t frames = recording.observed.frames.size();
  PipelineResult lines;
  lines.lines = result.lines;
  if (value_of(lines, 0, frames) != value_of(result, 0, frames)) return std::nullopt;
  std::vector<double> values;
  for (std::size_t f = 0; f < frames; ++f) values.push_back(value_of(lines, f, 1));
  return values;
}

/// Some neighbouring relations of a log, and the whole trajectory.
Rows of_relations(const MetricFamily& family, const Recording& recording, const PipelineResult& result,
                  const std::vector<PoseRelation>& relations, std::size_t first, std::size_t count) {
  const auto begin = relations.begin() + static_cast<std::ptrdiff_t>(first);
  const ReferencePoses reference{{}, {begin, begin + static_cast<std::ptrdiff_t>(count)}};
  return rows_of(family, recording.observed, nullptr, result, &reference);
}

/// The mean of parts, each with its weight.
struct Pool {
  double sum = 0.0, squares = 0.0, weight = 0.0;
  void add(double value, double w) {
    if (!(w > 0) || !std::isfinite(value)) return;
    sum += w * value;
    squares += w * value * value;
    weight += w;
  }
  double of(ScanMean mean) const { return mean == ScanMean::mean ? sum / weight : std::sqrt(squares / weight); }
  /// The mean that gives the value of the whole. Its count is the sum of theirs, too: else the parts are not of it.
  std::optional<ScanMean> mean_of(const MetricRow& whole) const {
    if (weight != static_cast<double>(whole.count)) return std::nullopt;
    for (const ScanMean mean : {ScanMean::mean, ScanMean::root_mean_square})
      if (std::fabs(of(mean) - whole.value) <= kSameMean * std::fabs(whole.value)) return mean;
    return std::nullopt;
  }
};

/// Metrics of a family that are means over parts. `rows_between(first, count)` gives the rows of `count` parts.
template <class RowsBetween>
std::map<std::string, ScanValues> means_over(std::size_t parts, const char* of, const RowsBetween& rows_between) {
  std::map<std::string, ScanValues> means;
  if (parts < kLeastScans) return means;
  const Rows whole = rows_between(std::size_t{0}, parts);
  // Two halves refuse most metrics that are not means, before every part is evaluated.
  std::map<std::string, Pool> halves;
  for (const auto& [first, count] : {std::pair(std::size_t{0}, parts / 2), std::pair(parts / 2, parts - parts / 2)})
    for (const auto& [metric, row] : rows_between(first, count))
      halves[metric].add(row.value, static_cast<double>(row.count));
  for (const auto& [metric, row] : whole)
    if (halves[metric].mean_of(row)) means[metric].of = of;
  if (means.empty()) return means;
  for (std::size_t i = 0; i < parts; ++i) {
    const Rows rows = rows_between(i, std::size_t{1});
    for (auto& [metric, mean] : means) {
      const auto row = rows.find(metric);
      const bool defined = row != rows.end() && std::isfinite(row->second.value) && row->second.count > 0;
      mean.values.push_back(defined ? row->second.value : kNaN);
      mean.weights.push_back(defined ? static_cast<double>(row->second.count) : 0.0);
    }
  }
  std::map<std::string, ScanValues> confirmed;
  for (auto& [metric, values] : means) {
    Pool pool;
    for (std::size_t i = 0; i < parts; ++i) pool.add(values.values[i], values.weights[i]);
    const auto mean = pool.mean_of(whole.at(metric));
    if (!mean) continue;
    values.mean = *mean;
    confirmed.emplace(metric, std::move(values));
  }
  return confirmed;
}

}  // namespace

struct ScanValueReader::Cell {
  std::vector<study::Scenario> scenarios;
  std::optional<std::pair<std::string, std::uint64_t>> source;  ///< of the recording
  Recording recording;
  std::optional<runs::CellKey> key;
  PipelineResult result;
  std::map<std::string, std::map<std::string, ScanValues>> families;  ///< of the cell, by family

  void load(const runs::RunStore& store, const runs::CellKey& of) {
    if (scenarios.empty()) scenarios = runs::load_run_scenarios(store.run());
    const std::pair wanted{of.scenario, of.seed};
    if (source != wanted) {
      recording = runs::load_recording(store.recording(of.scenario, of.seed));
      source = wanted;
    }
    if (key == of) return;
    result = runs::load_result(store.files(of));
    families.clear();
    key = of;
  }

  /// The scenario's metric family with this metric; nullptr if it has none.
  const study::ModuleChoice* family_of(const std::string& scenario_name, const std::string& metric) const {
    const auto scenario = std::ranges::find(scenarios, scenario_name, &study::Scenario::name);
    if (scenario == scenarios.end()) return nullptr;
    const auto family = std::ranges::find_if(scenario->metrics, [&](const study::ModuleChoice& choice) {
      const auto described = Registry<MetricFamily>::make(choice.module, choice.params)->describe();
      return std::ranges::find(described, metric, &metrics::MetricDescription::metric) != described.end();
    });
    return family == scenario->metrics.end() ? nullptr : &*family;
  }

  const std::map<std::string, ScanValues>& means_of(const study::ModuleChoice& choice) {
    const auto [place, is_new] = families.try_emplace(choice.module);
    if (!is_new) return place->second;
    const auto family = Registry<MetricFamily>::make(choice.module, choice.params);
    const std::size_t frames = recording.observed.frames.size();
    if (result.lines.size() != frames) return place->second;
    place->second = means_over(frames, kOfScans, [&](std::size_t first, std::size_t count) {
      return of_frames(*family, recording, result, first, count);
    });
    if (frames > 1)
      place->second.merge(means_over(frames - 1, kOfPairs, [&](std::size_t first, std::size_t count) {
        return of_frames(*family, recording, result, first, count + 1);
      }));
    if (!recording.reference || recording.reference->relations.empty()) return place->second;
    std::vector<PoseRelation> relations = recording.reference->relations;
    std::ranges::stable_sort(relations, {}, [](const PoseRelation& r) { return std::pair(r.first, r.second); });
    place->second.merge(means_over(relations.size(), "relations", [&](std::size_t first, std::size_t count) {
      return of_relations(*family, recording, result, relations, first, count);
    }));
    return place->second;
  }
};

ScanValueReader::ScanValueReader(fs::path run) : store_(std::move(run)), cell_(std::make_unique<Cell>()) {}
ScanValueReader::~ScanValueReader() = default;

bool ScanValueReader::is_log(const runs::CellKey& key) {
  const auto [known, is_new] = logs_.try_emplace({key.scenario, key.seed});
  if (is_new) {
    const runs::StoredFiles recording = store_.recording(key.scenario, key.seed);
    known->second = recording.has(runs::kRangesFile) && !recording.has(runs::kTrueRangesFile);
  }
  return known->second;
}

std::optional<ScanValues> ScanValueReader::of(const runs::CellKey& key, const std::string& metric) {
  cell_->load(store_, key);
  const study::ModuleChoice* family = cell_->family_of(key.scenario, metric);
  if (family == nullptr) return std::nullopt;
  const auto& means = cell_->means_of(*family);
  const auto found = means.find(metric);
  return found == means.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::vector<double>> ScanValueReader::by_scan(const runs::CellKey& key, const std::string& metric) {
  if (const auto mean = of(key, metric)) {
    const std::string_view parts = mean->of;
    if (parts == kOfScans) return mean->values;
    if (parts != kOfPairs) return std::nullopt;
    std::vector<double> values{kNaN};  // the first scan ends no pair
    values.insert(values.end(), mean->values.begin(), mean->values.end());
    return values;
  }
  const study::ModuleChoice* family = cell_->family_of(key.scenario, metric);
  if (family == nullptr) return std::nullopt;
  return of_single_frames(*Registry<MetricFamily>::make(family->module, family->params), cell_->recording,
                          cell_->result, metric);
}

}  // namespace scanbench::results
