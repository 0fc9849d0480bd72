// Writes and reads the tables of an archived run, and unpacks its cells.
#include "harness/store/archived_run.hpp"

#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "harness/files/atomic_file.hpp"
#include "harness/files/csv.hpp"
#include "harness/store/cell_status.hpp"
#include "harness/store/manifest.hpp"

namespace scanbench::harness {
namespace fs = std::filesystem;
namespace {

const std::vector<std::string> kCellColumns{
    "scenario",          "pipeline",     "seed",    "status",  "message", "wall_seconds", "cpu_seconds",
    "peak_memory_bytes", "scan_seconds", "address", "archive", "offset",  "bytes",        "sha256"};
const std::vector<std::string> kRecordingColumns{"scenario", "seed",  "content_hash", "archive",
                                                 "offset",   "bytes", "sha256"};

void part_fields(CsvWriter& csv, const std::string& archive, const ArchivePart& part) {
  csv.text(archive).seed(part.offset).seed(part.bytes).text(part.sha256);
}

ArchivePart part_from(const CsvTable& csv, std::size_t row) {
  return {static_cast<std::uint64_t>(csv.integer(row, "offset")), static_cast<std::uint64_t>(csv.integer(row, "bytes")),
          csv.text(row, "sha256")};
}

std::string archive_from(const CsvTable& csv, std::size_t row) {
  const std::string name = csv.text(row, "archive");
  check_name("archive", name);
  return name;
}

std::string unpack_command(const fs::path& run, const std::string& cell = "") {
  return "`scanbench unpack " + run.string() + (cell.empty() ? "" : " " + cell) + "`";
}

/// Unpacks folders of one run; the readers of its archives stay open.
class Unpacker {
 public:
  explicit Unpacker(const fs::path& run) : run_(run) {}

  void write(const fs::path& folder, const std::string& archive, const ArchivePart& part) {
    if (fs::exists(run_ / folder)) return;
    const auto reader = readers_.try_emplace(archive, archive_path(run_, archive)).first;
    StagedFolder staged(run_ / folder);
    for (const auto& [name, bytes] : reader->second.files(part, folder)) write_staged_file(staged.path() / name, bytes);
    staged.place();
  }

 private:
  const fs::path& run_;
  std::map<std::string, ArchiveReader> readers_;
};

/// The chosen cells; throws for a key that the run does not have.
std::vector<const ArchivedCell*> choose(const fs::path& run, const ArchiveTables& tables,
                                        const std::vector<CellKey>& keys) {
  std::map<CellKey, const ArchivedCell*> all;
  for (const auto& cell : tables.cells) all.emplace(cell.key, &cell);
  std::vector<const ArchivedCell*> chosen;
  for (const auto& key : keys) {
    const auto found = all.find(key);
    if (found == all.end()) throw ConfigError(run.string() + " has no cell " + to_string(key));
    chosen.push_back(found->second);
  }
  return chosen;
}

void remove_archives(const fs::path& run, const ArchiveTables& tables) {
  std::set<std::string> archives;
  for (const auto& cell : tables.cells) archives.insert(cell.archive);
  for (const auto& recording : tables.recordings) archives.insert(recording.archive);
  remove_file(run / kCellTable);  // from here on, the run is an ordinary one
  remove_file(run / kRecordingTable);
  for (const auto& name : archives) remove_file(archive_path(run, name));
  std::error_code not_empty;
  fs::remove(run / "archives", not_empty);
}

}  // namespace

bool has_archives(const fs::path& run) {
  std::error_code absent;
  return fs::exists(run / kCellTable, absent);
}

fs::path archive_path(const fs::path& run, const std::string& name) {
  return run / "archives" / name;
}

void write_archive_tables(const fs::path& run, const ArchiveTables& tables) {
  CsvWriter cells(kCellColumns), recordings(kRecordingColumns);
  for (const auto& cell : tables.cells) {
    const WorkerOutcome& outcome = cell.record.outcome;
    cells.text(cell.key.scenario).text(cell.key.pipeline).seed(cell.key.seed).text(to_string(outcome.status));
    cells.text(outcome.message).number(outcome.wall_seconds).number(outcome.cpu_seconds);
    cells.number(outcome.peak_memory_bytes).number(cell.scan_seconds).text(cell.record.address);
    part_fields(cells, cell.archive, cell.part);
    cells.end_row();
  }
  for (const auto& recording : tables.recordings) {
    recordings.text(recording.scenario).seed(recording.seed).text(recording.content_hash);
    part_fields(recordings, recording.archive, recording.part);
    recordings.end_row();
  }
  write_file_atomically(run / kRecordingTable, recordings.str());
  write_file_atomically(run / kCellTable, cells.str());
}

ArchiveTables load_archive_tables(const fs::path& run) {
  ArchiveTables tables;
  const CsvTable cells(read_file(run / kCellTable), run / kCellTable, kCellColumns);
  tables.cells.reserve(cells.rows());
  for (std::size_t r = 0; r < cells.rows(); ++r) {
    ArchivedCell& cell = tables.cells.emplace_back();
    cell.key = {cells.text(r, "scenario"), cells.text(r, "pipeline"),
                static_cast<std::uint64_t>(cells.integer(r, "seed"))};
    cell.record = {{.status = cell_status_from(cells.text(r, "status")),
                    .message = cells.text(r, "message"),
                    .wall_seconds = cells.number(r, "wall_seconds"),
                    .cpu_seconds = cells.number(r, "cpu_seconds"),
                    .peak_memory_bytes = cells.number(r, "peak_memory_bytes")},
                   cells.text(r, "address")};
    cell.scan_seconds = cells.number(r, "scan_seconds");
    cell.archive = archive_from(cells, r);
    cell.part = part_from(cells, r);
  }
  const CsvTable recordings(read_file(run / kRecordingTable), run / kRecordingTable, kRecordingColumns);
  for (std::size_t r = 0; r < recordings.rows(); ++r)
    tables.recordings.push_back(
        {recordings.text(r, "scenario"), static_cast<std::uint64_t>(recordings.integer(r, "seed")),
         recordings.text(r, "content_hash"), archive_from(recordings, r), part_from(recordings, r)});
  return tables;
}

void require_cell(const fs::path& run, const CellKey& key) {
  if (!has_archives(run) || fs::exists(cell_path(run, key))) return;
  throw ConfigError(run.string() + " keeps the cell " + to_string(key) + " in an archive; " +
                    unpack_command(run, to_string(key)) + " writes its files");
}

void require_all_cells(const fs::path& run) {
  if (!has_archives(run)) return;
  throw ConfigError(run.string() + " keeps its cells in archives; " + unpack_command(run) +
                    " writes all of their files");
}

CellRecords::CellRecords(const fs::path& run) : run_(run) {
  if (!has_archives(run)) return;
  table_.emplace();
  for (auto& cell : load_archive_tables(run).cells) table_->emplace(std::move(cell.key), std::move(cell.record));
}

std::optional<CellRecord> CellRecords::of(const CellKey& key) const {
  if (table_) {
    const auto found = table_->find(key);
    return found == table_->end() ? std::nullopt : std::optional(found->second);
  }
  const fs::path cell = cell_path(run_, key);
  return fs::exists(cell / kStatusFile) ? std::optional(load_status(cell)) : std::nullopt;
}

std::size_t unpack_cells(const fs::path& run, const std::vector<CellKey>& keys,
                         const std::function<void(double)>& progress) {
  const ArchiveTables tables = load_archive_tables(run);
  std::map<std::pair<std::string, std::uint64_t>, const ArchivedRecording*> recordings;
  for (const auto& recording : tables.recordings)
    recordings.emplace(std::pair(recording.scenario, recording.seed), &recording);
  Unpacker unpacker(run);
  std::size_t written = 0;
  const auto chosen = choose(run, tables, keys);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const CellKey& key = chosen[i]->key;
    if (progress) progress(static_cast<double>(i) / static_cast<double>(chosen.size()));
    if (const auto recording = recordings.find({key.scenario, key.seed}); recording != recordings.end())
      unpacker.write(recording_path("", key.scenario, key.seed), recording->second->archive, recording->second->part);
    if (!fs::exists(cell_path(run, key))) ++written;
    unpacker.write(cell_path("", key), chosen[i]->archive, chosen[i]->part);
  }
  flush_file_system(run);
  const bool all =
      std::ranges::all_of(tables.cells, [&](const ArchivedCell& cell) { return fs::exists(cell_path(run, cell.key)); });
  if (all) remove_archives(run, tables);
  refresh_manifest(run);
  return written;
}

}  // namespace scanbench::harness
