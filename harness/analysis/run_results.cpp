// Reads the results of a run from its folder.
#include "harness/analysis/run_results.hpp"

#include <map>
#include <utility>

#include "harness/analysis/selection.hpp"
#include "harness/store/archived_run.hpp"
#include "harness/store/cell_files.hpp"
#include "harness/store/cell_status.hpp"
#include "harness/store/manifest.hpp"
#include "harness/store/recording_folder.hpp"
#include "harness/store/run_scenarios.hpp"
#include "harness/store/summary.hpp"

namespace scanbench::harness {
namespace fs = std::filesystem;
namespace {

CellResults load_cell(const fs::path& run, const CellKey& key) {
  CellResults cell;
  cell.key = key;
  cell.status = "missing";
  const fs::path folder = cell_path(run, key);
  if (!fs::exists(folder / kStatusFile)) return cell;
  const CellRecord record = load_status(folder);
  cell.status = to_string(record.outcome.status);
  cell.message = record.outcome.message;
  if (record.outcome.status == CellStatus::ok) cell.rows = load_metrics(folder);
  return cell;
}

/// The cells of an archived run, whose files are not there.
std::vector<CellResults> load_archived_cells(const fs::path& run) {
  const ArchiveTables tables = load_archive_tables(run);
  std::map<std::pair<std::string, std::uint64_t>, std::string> recordings;
  for (const auto& recording : tables.recordings)
    recordings.emplace(std::pair(recording.scenario, recording.seed), recording.content_hash);
  std::map<CellKey, std::size_t> places;
  std::vector<CellResults> cells;
  for (const auto& archived : tables.cells) {
    places.emplace(archived.key, cells.size());
    CellResults& cell = cells.emplace_back();
    cell.key = archived.key;
    cell.status = to_string(archived.record.outcome.status);
    cell.message = archived.record.outcome.message;
    const auto recording = recordings.find({cell.key.scenario, cell.key.seed});
    if (recording != recordings.end()) cell.recording = recording->second;
  }
  for (auto& row : load_summary(run / kSummaryFile))
    if (const auto place = places.find({row.scenario, row.pipeline, row.seed}); place != places.end())
      cells[place->second].rows.push_back({.metric = std::move(row.metric),
                                           .subject = std::move(row.subject),
                                           .value = row.value,
                                           .unit = std::move(row.unit),
                                           .count = row.count,
                                           .ci_low = {},
                                           .ci_high = {}});
  return cells;
}

}  // namespace

RunResults load_run_results(const fs::path& run) {
  RunResults results;
  results.name = run.string();
  const Manifest manifest = load_manifest(run);
  results.provenance = load_provenance(run);
  results.settings = load_run_settings(run);
  if (has_archives(run)) {
    results.cells = load_archived_cells(run);
    return results;
  }
  results.folder = run;
  std::map<std::pair<std::string, std::uint64_t>, std::string> recordings;
  for (const auto& key : manifest.cells) {
    CellResults cell = load_cell(run, key);
    cell.requested = was_selected(manifest, key);
    const auto [recording, is_new] = recordings.try_emplace({key.scenario, key.seed});
    // A run that was kept without its recordings still has its values.
    if (const fs::path folder = recording_path(run, key.scenario, key.seed); is_new && fs::exists(folder / kScanFile))
      recording->second = stated_recording_hash(folder);
    cell.recording = recording->second;
    results.cells.push_back(std::move(cell));
  }
  return results;
}

}  // namespace scanbench::harness
