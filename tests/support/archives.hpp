// Moves the cells of a run into an archive, for tests of what reads such runs.
#pragma once

#include <filesystem>

#include "core/special_values.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/runs/store/archived_run.hpp"
#include "harness/runs/store/cell_archive.hpp"
#include "harness/runs/store/cell_table.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "harness/runs/store/run_store.hpp"

namespace scanbench::fixtures {

/// The run has one archive and no folders of cells or recordings afterwards.
inline void archive_cells(const std::filesystem::path& run) {
  const runs::RunStore store(run);
  io::make_folders(run / "archives");
  runs::ArchiveWriter writer(runs::archive_path(run, "1.tar"));
  runs::CellTable table;
  for (const auto& [scenario, seed] : store.recordings())
    table.recordings.push_back({scenario, seed, store.recording_hash(scenario, seed), "1.tar",
                                writer.add(runs::recording_path("", scenario, seed),
                                           runs::read_folder(runs::recording_path(run, scenario, seed)))});
  for (const runs::CellKey& key : store.keys())
    table.cells.push_back({.key = key,
                           .record = store.record(key).value(),
                           .scan_seconds = store.scan_seconds(key).value_or(kNaN),
                           .result = "",
                           .summary_begin = 0,
                           .summary_size = 0,
                           .archive = "1.tar",
                           .part = writer.add(runs::cell_path("", key), runs::read_folder(runs::cell_path(run, key)))});
  writer.finish();
  for (const char* folder : {"cells", "recordings"}) std::filesystem::remove_all(run / folder);
  runs::write_archive_tables(run, table);
}

}  // namespace scanbench::fixtures
