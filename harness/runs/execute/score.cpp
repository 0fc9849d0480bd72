// Scores cells with metric families, and scores a finished run again.
#include "harness/runs/execute/score.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "core/error.hpp"
#include "core/registry.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/csv.hpp"
#include "harness/runs/execute/cell_address.hpp"
#include "harness/runs/store/cell_files.hpp"
#include "harness/runs/store/cell_status.hpp"
#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/recording_folder.hpp"
#include "harness/runs/store/run_store.hpp"
#include "harness/runs/store/summary.hpp"
#include "harness/study/scenario/figure_pipelines.hpp"
#include "harness/study/scenario/trace_choice.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;

namespace {

metrics::MetricInput metric_input(const Recording& recording, const PipelineResult& result) {
  return {recording.observed, recording.truth ? &*recording.truth : nullptr, result,
          recording.reference ? &*recording.reference : nullptr};
}

/// Whole metres near the walls' corner if it is far from zero, as in coordinates of a map; else zero. Distances of
/// lines from zero, which metrics compare, lose their meaning there: an angle of 1e-6 rad moves them by metres.
Vec2 place_of_scene(const Recording& recording) {
  constexpr double kFar_m = 1e4;
  if (!recording.truth || recording.truth->walls.empty()) return Vec2::Zero();
  Vec2 corner = recording.truth->walls.front().segment.a;
  for (const Wall& wall : recording.truth->walls) corner = corner.cwiseMin(wall.segment.a).cwiseMin(wall.segment.b);
  if (!corner.allFinite() || corner.cwiseAbs().maxCoeff() < kFar_m) return Vec2::Zero();
  return {std::round(corner.x()), std::round(corner.y())};
}

void shift(Pose2& pose, const Vec2& by) {
  pose = Pose2::from_unit(pose.translation() + by, {pose.cos(), pose.sin()});
}

void shift(Segment& segment, const Vec2& by) {
  segment = {segment.a + by, segment.b + by};
}

void move_scene(Recording& recording, PipelineResult& result, const Vec2& by) {
  for (Wall& wall : recording.truth->walls) shift(wall.segment, by);
  for (Pose2& pose : recording.truth->world_from_sensor) shift(pose, by);
  for (Frame& frame : recording.observed.frames) shift(frame.odom_from_sensor, by);
  if (recording.reference)
    for (Pose2& pose : recording.reference->world_from_sensor) shift(pose, by);
  for (Pose2& pose : result.world_from_sensor) shift(pose, by);
  for (MapLine& line : result.map.lines) shift(line.segment, by);
}

/// Calls `use` with the name of every chosen family that applies to the input, and the family.
template <class Use>
void for_each_family(const std::vector<study::ModuleChoice>& families, const metrics::MetricInput& input, Use use) {
  for (const auto& choice : families) {
    const auto family = Registry<metrics::MetricFamily>::make(choice.module, choice.params);
    if (family->applies(input)) use(choice.module, *family);
  }
}

constexpr std::string_view kRefusals = "metrics: ";  // begins the last part of a cell's message

template <class T>
void append(std::vector<T>& all, std::vector<T> more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// Checks whether a run of a scenario would make a cell with this address.
class ScenarioAddresses {
 public:
  bool is_of(const study::Scenario& scenario, const CellKey& key, const std::string& address) {
    const auto pipeline = std::ranges::find(scenario.pipelines, key.pipeline, &study::PipelineSpec::name);
    if (pipeline == scenario.pipelines.end()) return false;
    std::string& input = inputs_[scenario.name];
    if (input.empty()) input = input_address(scenario);
    const std::string work = work_address(scenario.metrics, *pipeline);
    const study::TraceChoice traces[] = {{}, {.all = true}, study::traces_drawn(scenario, key.pipeline)};
    return std::ranges::any_of(
        traces, [&](const study::TraceChoice& trace) { return address == cell_address(input, work, key.seed, trace); });
  }

 private:
  std::map<std::string, std::string> inputs_;  // kept, because a log's takes a hash of the whole file
};

}  // namespace

int skip_matches_requested(const std::vector<study::ModuleChoice>& families) {
  int most = 0;
  for (const auto& choice : families)
    most = std::max(most, Registry<metrics::MetricFamily>::make(choice.module, choice.params)->skip_matches());
  return most;
}

Scores evaluate_metrics(const std::vector<study::ModuleChoice>& families, const Recording& recording,
                        const PipelineResult& result) {
  if (const Vec2 place = place_of_scene(recording); !place.isZero(0.0)) {
    Recording near = recording;
    PipelineResult near_result = result;
    move_scene(near, near_result, -place);
    return evaluate_metrics(families, near, near_result);
  }
  const metrics::MetricInput input = metric_input(recording, result);
  Scores scores;
  for_each_family(families, input, [&](const std::string& name, const auto& family) {
    try {
      auto rows = family.evaluate(input);
      auto tables = family.tables(input);
      const auto names = family.table_names();
      for (const auto& table : tables) SCANBENCH_ASSERT(std::ranges::find(names, table.name) != names.end());
      append(scores.rows, std::move(rows));
      append(scores.tables, std::move(tables));
    } catch (const ConfigError& refusal) {
      const std::string prefix = name + ": ", what = refusal.what();
      scores.refusals +=
          (scores.refusals.empty() ? std::string(kRefusals) : "; ") + (what.starts_with(prefix) ? "" : prefix) + what;
    }
  });
  return scores;
}

Scores score_cell(const std::vector<study::ModuleChoice>& families, const Recording& recording, const fs::path& cell) {
  const PipelineResult result = load_result(cell);
  if (result.lines.size() != recording.observed.frames.size())
    throw ConfigError(cell.string() + ": " + std::to_string(result.lines.size()) + " frames; the recording has " +
                      std::to_string(recording.observed.frames.size()));
  return evaluate_metrics(families, recording, result);
}

std::string message_with(const std::string& message, const std::string& refusals) {
  const std::size_t old = message.starts_with(kRefusals) ? 0 : message.find("; " + std::string(kRefusals));
  const std::string kept = message.substr(0, old);
  return kept + (kept.empty() || refusals.empty() ? "" : "; ") + refusals;
}

std::string metric_table_csv(const metrics::MetricTable& table) {
  io::CsvWriter csv(table.columns);
  for (const auto& row : table.rows) {
    for (const double value : row) csv.number(value);
    csv.end_row();
  }
  return csv.str();
}

std::size_t score_run(const fs::path& run, const std::vector<study::Scenario>& scenarios,
                      const std::function<void(double, const std::string&)>& progress) {
  const RunStore store(run);
  store.require_folders();  // because it writes into them
  const std::vector<CellKey> keys = store.keys();
  std::string summary = summary_header();
  std::size_t scored = 0;
  const std::set<std::string> known_tables = metric_table_files();
  std::vector<std::pair<fs::path, std::string>>
      files;                    // written when all are known, so that an interrupt changes nothing
  std::vector<fs::path> stale;  // tables of an earlier score that this one does not make
  ScenarioAddresses addresses;
  std::map<std::pair<std::string, std::uint64_t>, Recording> recordings;  // at most one at a time
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const CellKey& key = keys[i];
    if (progress) progress(static_cast<double>(i) / static_cast<double>(keys.size()), to_string(key));
    auto record = store.record(key);
    if (!record || record->outcome.status != CellStatus::ok) continue;
    const fs::path cell = cell_path(run, key);
    const auto scenario = std::ranges::find(scenarios, key.scenario, &study::Scenario::name);
    if (scenario == scenarios.end())
      throw ConfigError(run.string() + ": the scenario '" + key.scenario + "' of a cell is missing");
    const std::pair source{key.scenario, key.seed};
    if (!recordings.contains(source)) {
      recordings.clear();
      recordings.emplace(source, load_recording(recording_path(run, key.scenario, key.seed)));
    }
    const Scores scores = score_cell(scenario->metrics, recordings.at(source), cell);
    files.emplace_back(cell / kMetricsFile, metrics_csv(scores.rows));
    const std::string message = message_with(record->outcome.message, scores.refusals);
    const bool other_metrics = !addresses.is_of(*scenario, key, record->address);
    if (other_metrics) record->address.clear();  // no run has these metrics, so --resume makes the cell again
    if (other_metrics || message != record->outcome.message) {
      record->outcome.message = message;
      files.emplace_back(cell / kStatusFile, status_json(*record));
    }
    std::set<std::string> others = known_tables;
    for (const auto& table : scores.tables) {
      files.emplace_back(cell / (table.name + ".csv"), metric_table_csv(table));
      others.erase(table.name + ".csv");
    }
    for (const auto& file : others) stale.push_back(cell / file);
    summary += summary_lines(key, scores.rows);
    ++scored;
  }
  for (const auto& path : stale) io::remove_file(path);
  for (const auto& [path, text] : files) io::write_file_atomically(path, text);
  io::write_file_atomically(run / kSummaryFile, summary);
  refresh_manifest(run);
  return scored;
}

}  // namespace scanbench::runs
