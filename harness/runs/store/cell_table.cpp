// Writes and reads the rows of cells.csv and recordings.csv.
#include "harness/runs/store/cell_table.hpp"

#include <algorithm>
#include <utility>

#include "harness/io/files/csv.hpp"
#include "harness/runs/store/cell_status.hpp"
#include "harness/runs/store/summary.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;
namespace {

// Earlier versions wrote some columns only into the tables of shards, or only into those of runs.
constexpr const char* kResult = "result";
constexpr const char* kSummaryBytes = "summary_bytes";
constexpr const char* kArchive = "archive";

const std::vector<std::string> kWrittenCellColumns{
    "scenario",          "pipeline",     "seed",  "address",     "status", "message", "wall_seconds", "cpu_seconds",
    "peak_memory_bytes", "scan_seconds", kResult, kSummaryBytes, kArchive, "offset",  "bytes",        "sha256"};
const std::vector<std::string> kWrittenRecordingColumns{"scenario", "seed",  "content_hash", kArchive,
                                                        "offset",   "bytes", "sha256"};

std::vector<std::string> required_of(std::vector<std::string> columns) {
  std::erase_if(columns,
                [](const std::string& name) { return name == kResult || name == kSummaryBytes || name == kArchive; });
  return columns;
}

void place_fields(io::CsvWriter& csv, const std::string& archive, const ArchivePart& part) {
  csv.text(archive).seed(part.offset).seed(part.bytes).text(part.sha256);
}

std::uint64_t whole_number(const io::CsvTable& csv, std::size_t row, const char* column) {
  return static_cast<std::uint64_t>(csv.integer(row, column));
}

ArchivePart part_from(const io::CsvTable& csv, std::size_t row) {
  return {whole_number(csv, row, "offset"), whole_number(csv, row, "bytes"), csv.text(row, "sha256")};
}

std::string archive_from(const io::CsvTable& csv, std::size_t row) {
  if (!csv.has(kArchive)) return "";
  return csv.folder_name(row, kArchive);
}

/// Field by field: g++ 12 frees the strings of an aggregate twice if one of its initialisers throws.
ArchivedCell cell_from(const io::CsvTable& csv, std::size_t row) {
  ArchivedCell cell;
  cell.key.scenario = csv.folder_name(row, "scenario");
  cell.key.pipeline = csv.folder_name(row, "pipeline");
  cell.key.seed = whole_number(csv, row, "seed");
  WorkerOutcome& outcome = cell.record.outcome;
  outcome.status = cell_status_from(csv.text(row, "status"));
  outcome.message = csv.text(row, "message");
  outcome.wall_seconds = csv.number(row, "wall_seconds");
  outcome.cpu_seconds = csv.number(row, "cpu_seconds");
  outcome.peak_memory_bytes = csv.number(row, "peak_memory_bytes");
  cell.record.address = csv.text(row, "address");
  cell.scan_seconds = csv.number(row, "scan_seconds");
  if (csv.has(kResult)) cell.result = csv.text(row, kResult);
  if (csv.has(kSummaryBytes)) cell.summary_size = whole_number(csv, row, kSummaryBytes);
  cell.archive = archive_from(csv, row);
  cell.part = part_from(csv, row);
  return cell;
}

}  // namespace

const ArchivedRecording* CellTable::recording(const std::string& scenario, std::uint64_t seed) const {
  const auto key_of = [](const ArchivedRecording& recording) { return std::pair(recording.scenario, recording.seed); };
  const std::pair key(scenario, seed);
  const auto found = std::ranges::lower_bound(recordings, key, {}, key_of);
  return found != recordings.end() && key_of(*found) == key ? &*found : nullptr;
}

std::string cells_csv(const std::vector<ArchivedCell>& cells) {
  io::CsvWriter csv(kWrittenCellColumns);
  for (const auto& cell : cells) {
    const WorkerOutcome& outcome = cell.record.outcome;
    csv.text(cell.key.scenario).text(cell.key.pipeline).seed(cell.key.seed).text(cell.record.address);
    csv.text(to_string(outcome.status)).text(outcome.message).number(outcome.wall_seconds).number(outcome.cpu_seconds);
    csv.number(outcome.peak_memory_bytes).number(cell.scan_seconds).text(cell.result).seed(cell.summary_size);
    place_fields(csv, cell.archive, cell.part);
    csv.end_row();
  }
  return csv.str();
}

std::string recordings_csv(const std::vector<ArchivedRecording>& recordings) {
  io::CsvWriter csv(kWrittenRecordingColumns);
  for (const auto& recording : recordings) {
    csv.text(recording.scenario).seed(recording.seed).text(recording.content_hash);
    place_fields(csv, recording.archive, recording.part);
    csv.end_row();
  }
  return csv.str();
}

CellTable parse_cell_table(std::string cells, std::string recordings, const fs::path& folder) {
  static const auto required_of_cells = required_of(kWrittenCellColumns);
  static const auto required_of_recordings = required_of(kWrittenRecordingColumns);
  CellTable table;
  const io::CsvTable of_cells(std::move(cells), folder / kCellTable, required_of_cells);
  table.cells.reserve(of_cells.rows());
  std::size_t begin = summary_header().size();
  for (std::size_t r = 0; r < of_cells.rows(); ++r) {
    ArchivedCell& cell = table.cells.emplace_back(cell_from(of_cells, r));
    cell.summary_begin = begin;
    begin += cell.summary_size;
  }
  const io::CsvTable of_recordings(std::move(recordings), folder / kRecordingTable, required_of_recordings);
  for (std::size_t r = 0; r < of_recordings.rows(); ++r)
    table.recordings.push_back({of_recordings.folder_name(r, "scenario"), whole_number(of_recordings, r, "seed"),
                                of_recordings.text(r, "content_hash"), archive_from(of_recordings, r),
                                part_from(of_recordings, r)});
  return table;
}

}  // namespace scanbench::runs
