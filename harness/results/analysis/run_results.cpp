// Reads the results of a run from its folder.
#include "harness/results/analysis/run_results.hpp"

#include "harness/results/analysis/selection.hpp"
#include "harness/runs/store/cell_status.hpp"
#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/run_scenarios.hpp"
#include "harness/runs/store/run_store.hpp"

namespace scanbench::results {

RunResults load_run_results(const std::filesystem::path& run) {
  RunResults results;
  results.name = run.string();
  const runs::Manifest manifest = runs::load_manifest(run);
  results.provenance = runs::load_provenance(run);
  results.settings = runs::load_run_settings(run);
  results.folder = run;
  results.overrides = overrides_of(manifest);
  const runs::RunStore store(run);
  for (const auto& key : manifest.cells) {
    CellResults& cell = results.cells.emplace_back();
    cell.key = key;
    cell.requested = was_selected(manifest, key);
    cell.status = "missing";
    cell.recording = store.recording_hash(key.scenario, key.seed);
    const auto record = store.record(key);
    if (!record) continue;
    cell.status = runs::to_string(record->outcome.status);
    cell.message = record->outcome.message;
    if (record->outcome.status == runs::CellStatus::ok) cell.rows = store.metrics(key);
  }
  return results;
}

}  // namespace scanbench::results
