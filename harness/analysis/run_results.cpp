// Reads the results of a run from its folder.
#include "harness/analysis/run_results.hpp"

#include <set>
#include <utility>

#include "harness/analysis/selection.hpp"
#include "harness/store/cell_files.hpp"
#include "harness/store/cell_status.hpp"
#include "harness/store/manifest.hpp"
#include "harness/store/recording_folder.hpp"
#include "harness/store/run_scenarios.hpp"

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

}  // namespace

RunResults load_run_results(const fs::path& run) {
  RunResults results;
  results.name = run.string();
  results.folder = run;
  const Manifest manifest = load_manifest(run);
  results.provenance = load_provenance(run);
  results.settings = load_run_settings(run);
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
