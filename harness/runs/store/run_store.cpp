// Finds the files of cells and recordings in the folders of a run or in its archives.
#include "harness/runs/store/run_store.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <tuple>

#include "core/error.hpp"
#include "harness/io/files/folder.hpp"
#include "harness/runs/store/cell_status.hpp"
#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/recording_folder.hpp"
#include "harness/runs/store/summary.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;
namespace {

/// The seed that names a recording's folder; nothing for any other name.
std::optional<std::uint64_t> seed_of(const std::string& name) {
  std::uint64_t seed = 0;
  const char* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data(), end, seed);
  return error == std::errc() && stop == end ? std::optional(seed) : std::nullopt;
}

std::map<CellKey, std::vector<metrics::MetricRow>> summarised_metrics(const fs::path& run) {
  std::map<CellKey, std::vector<metrics::MetricRow>> metrics;
  for (auto& row : load_summary(run / kSummaryFile))
    metrics[{std::move(row.scenario), std::move(row.pipeline), row.seed}].push_back({.metric = std::move(row.metric),
                                                                                     .subject = std::move(row.subject),
                                                                                     .value = row.value,
                                                                                     .unit = std::move(row.unit),
                                                                                     .count = row.count,
                                                                                     .ci_low = {},
                                                                                     .ci_high = {}});
  return metrics;
}

}  // namespace

RunStore::RunStore(fs::path run) : run_(std::move(run)) {
  if (has_archives(run_)) archives_.emplace(run_);
}

std::vector<CellKey> RunStore::keys() const {
  return load_manifest(run_).cells;
}

std::optional<CellRecord> RunStore::record(const CellKey& key) const {
  if (archives_) {
    const ArchivedCell* cell = archives_->cell(key);
    return cell == nullptr ? std::nullopt : std::optional(cell->record);
  }
  const StoredFiles cell = files(key);
  return cell.has(kStatusFile) ? std::optional(load_status(cell)) : std::nullopt;
}

bool RunStore::is_ok(const CellKey& key) const {
  const auto found = record(key);
  return found && found->outcome.status == CellStatus::ok;
}

StoredFiles RunStore::files(const CellKey& key) const {
  const fs::path folder = cell_path(run_, key);
  const ArchivedCell* cell = archives_ ? archives_->cell(key) : nullptr;
  return cell == nullptr || fs::exists(folder) ? StoredFiles(folder) : StoredFiles(folder, archives_->files(*cell));
}

std::vector<metrics::MetricRow> RunStore::metrics(const CellKey& key) const {
  if (!archives_) {
    const StoredFiles cell = files(key);
    return cell.has(kMetricsFile) ? load_metrics(cell) : std::vector<metrics::MetricRow>();
  }
  if (!metrics_) metrics_ = summarised_metrics(run_);
  const auto found = metrics_->find(key);
  return found == metrics_->end() ? std::vector<metrics::MetricRow>() : found->second;
}

std::optional<double> RunStore::scan_seconds(const CellKey& key) const {
  if (archives_) {
    const ArchivedCell* cell = archives_->cell(key);
    return cell != nullptr && std::isfinite(cell->scan_seconds) ? std::optional(cell->scan_seconds) : std::nullopt;
  }
  const StoredFiles cell = files(key);
  if (!cell.has(kTimingFile)) return std::nullopt;
  const double scans = facts_of({key.scenario, key.seed}).scans;
  return scans > 0 ? std::optional(stage_seconds(cell.table(kTimingFile, {"seconds"})) / scans) : std::nullopt;
}

std::vector<RunStore::RecordingKey> RunStore::recordings() const {
  std::vector<RecordingKey> found;
  const fs::path folder = run_ / "recordings";
  for (const auto& scenario : io::names_in(folder))
    for (const auto& name : io::names_in(folder / scenario))
      if (const auto seed = seed_of(name)) found.emplace_back(scenario, *seed);
  if (archives_)
    for (const auto& recording : archives_->table().recordings) found.emplace_back(recording.scenario, recording.seed);
  std::ranges::sort(found, {}, [](const RecordingKey& key) { return std::tuple(key.first.size(), key); });
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

StoredFiles RunStore::recording(const std::string& scenario, std::uint64_t seed) const {
  const fs::path folder = recording_path(run_, scenario, seed);
  const ArchivedRecording* recording = archives_ ? archives_->table().recording(scenario, seed) : nullptr;
  return recording == nullptr || fs::exists(folder) ? StoredFiles(folder)
                                                    : StoredFiles(folder, archives_->files(*recording));
}

std::string RunStore::recording_hash(const std::string& scenario, std::uint64_t seed) const {
  if (!archives_) return facts_of({scenario, seed}).content_hash;
  const ArchivedRecording* recording = archives_->table().recording(scenario, seed);
  return recording == nullptr ? "" : recording->content_hash;
}

const RunStore::RecordingFacts& RunStore::facts_of(const RecordingKey& key) const {
  const auto [facts, is_new] = facts_.try_emplace(key);
  if (!is_new) return facts->second;
  const StoredFiles files = recording(key.first, key.second);
  if (files.has(kScanFile)) facts->second = {stated_recording_hash(files), stated_scans(files)};
  return facts->second;
}

void RunStore::require_folders() const {
  if (!archives_) return;
  throw ConfigError(run_.string() + " keeps its cells in archives; `scanbench sweep unpack " + run_.string() +
                    "` writes all of their files");
}

}  // namespace scanbench::runs
