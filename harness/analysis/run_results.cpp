// Reads the results of a run from its folder.
#include "harness/analysis/run_results.hpp"

#include "harness/analysis/selection.hpp"
#include "harness/store/cell_status.hpp"
#include "harness/store/manifest.hpp"
#include "harness/store/run_scenarios.hpp"
#include "harness/store/run_store.hpp"

namespace scanbench::harness {

RunResults load_run_results(const std::filesystem::path& run) {
  RunResults results;
  results.name = run.string();
  const Manifest manifest = load_manifest(run);
  results.provenance = load_provenance(run);
  results.settings = load_run_settings(run);
  results.folder = run;
  const RunStore store(run);
  for (const auto& key : manifest.cells) {
    CellResults& cell = results.cells.emplace_back();
    cell.key = key;
    cell.requested = was_selected(manifest, key);
    cell.status = "missing";
    cell.recording = store.recording_hash(key.scenario, key.seed);
    const auto record = store.record(key);
    if (!record) continue;
    cell.status = to_string(record->outcome.status);
    cell.message = record->outcome.message;
    if (record->outcome.status == CellStatus::ok) cell.rows = store.metrics(key);
  }
  return results;
}

}  // namespace scanbench::harness
