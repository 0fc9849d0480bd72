// Moves the cells of a run into an archive, for tests of what reads such runs.
#pragma once

#include <filesystem>

#include "core/special_values.hpp"
#include "harness/files/atomic_file.hpp"
#include "harness/store/archived_run.hpp"
#include "harness/store/cell_archive.hpp"
#include "harness/store/cell_table.hpp"
#include "harness/store/run_folder.hpp"
#include "harness/store/run_store.hpp"

namespace scanbench::harness::fixtures {

/// The run has one archive and no folders of cells or recordings afterwards.
inline void archive_cells(const std::filesystem::path& run) {
  const RunStore store(run);
  make_folders(run / "archives");
  ArchiveWriter writer(archive_path(run, "1.tar"));
  CellTable table;
  for (const auto& [scenario, seed] : store.recordings())
    table.recordings.push_back(
        {scenario, seed, store.recording_hash(scenario, seed), "1.tar",
         writer.add(recording_path("", scenario, seed), read_folder(recording_path(run, scenario, seed)))});
  for (const CellKey& key : store.keys())
    table.cells.push_back({.key = key,
                           .record = store.record(key).value(),
                           .scan_seconds = store.scan_seconds(key).value_or(kNaN),
                           .result = "",
                           .summary_begin = 0,
                           .summary_size = 0,
                           .archive = "1.tar",
                           .part = writer.add(cell_path("", key), read_folder(cell_path(run, key)))});
  writer.finish();
  for (const char* folder : {"cells", "recordings"}) std::filesystem::remove_all(run / folder);
  write_archive_tables(run, table);
}

}  // namespace scanbench::harness::fixtures
