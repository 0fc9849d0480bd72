// Writes, reads and checks the folders that shards commit.
#include "harness/sweep/shard_commit.hpp"

#include <algorithm>
#include <charconv>

#include <unistd.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/special_values.hpp"
#include "harness/files/csv.hpp"
#include "harness/files/folder.hpp"
#include "harness/files/hash.hpp"
#include "harness/files/json.hpp"
#include "harness/store/cell_files.hpp"
#include "harness/store/json_file.hpp"
#include "harness/store/recording_folder.hpp"
#include "harness/store/summary.hpp"

namespace scanbench::harness {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;
using Columns = std::vector<std::string>;

constexpr const char* kCommitFile = "commit.json";
constexpr const char* kArchiveFile = "cells.tar";
constexpr const char* kCellsFile = "cells.csv";
constexpr const char* kRecordingsFile = "recordings.csv";
constexpr const char* kTables[] = {kCellsFile, kRecordingsFile, "summary.csv"};

const Columns kCellColumns{
    "scenario",          "pipeline",     "seed",   "address",       "status", "message", "wall_seconds", "cpu_seconds",
    "peak_memory_bytes", "scan_seconds", "result", "summary_bytes", "offset", "bytes",   "sha256"};
const Columns kRecordingColumns{"scenario", "seed", "content_hash", "offset", "bytes", "sha256"};

/// metrics.csv without the times.
std::string without_times(const std::string& csv) {
  std::string rest;
  for (std::size_t begin = 0; begin < csv.size();) {
    const std::size_t end = std::min(csv.find('\n', begin), csv.size() - 1) + 1;
    const std::string_view line = std::string_view(csv).substr(begin, end - begin);
    if (!line.starts_with("t_")) rest += line;
    begin = end;
  }
  return rest;
}

std::string status_in(const std::string& bytes) {
  const nlohmann::json json = parsed_json(bytes);
  return json.is_object() ? json.value("status", "") : "";
}

/// The part of a file that must be equal each time it is made.
std::string repeatable_part(const std::string& name, const std::string& bytes) {
  if (name == kTimingFile.name()) return "";
  if (name == kMetricsFile.name()) return without_times(bytes);
  if (name == kStatusFile.name()) return status_in(bytes);
  return bytes;
}

std::string repeatable_hash(const FolderFiles& files) {
  Sha256 hash;
  for (const auto& [name, bytes] : files) hash.part(name, repeatable_part(name, bytes));
  return hash.hex();
}

double sum_of_seconds(const std::string& timing) {
  const CsvTable table(timing, kTimingFile.name(), {"seconds"});
  double sum = 0.0;
  for (std::size_t row = 0; row < table.rows(); ++row) sum += table.number(row, "seconds");
  return sum;
}

std::string host_name() {
  char name[256] = {};
  ::gethostname(name, sizeof name - 1);
  return name;
}

fs::path shards_path(const fs::path& sweep) {
  return sweep / "shards";
}

/// The number in "7.0123456789abcdef"; 0 for any other name.
int number_in_name(const std::string& name) {
  int number = 0;
  const auto [stop, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  return error == std::errc() && stop != name.data() + name.size() && *stop == '.' ? number : 0;
}

StagedFolder stage_shard(const fs::path& sweep, int number) {
  const std::string unique = unique_name();
  const fs::path target = shards_path(sweep) / (std::to_string(number) + "." + unique);
  return {target, shards_path(sweep) / ("." + std::to_string(number) + ".tmp-" + unique)};
}

void part_fields(CsvWriter& csv, const ArchivePart& part) {
  csv.seed(part.offset).seed(part.bytes).text(part.sha256);
}

ArchivePart part_from(const CsvTable& csv, std::size_t row) {
  return {static_cast<std::uint64_t>(csv.integer(row, "offset")), static_cast<std::uint64_t>(csv.integer(row, "bytes")),
          csv.text(row, "sha256")};
}

std::string cells_csv(const std::vector<CommittedCell>& cells) {
  CsvWriter csv(kCellColumns);
  for (const auto& cell : cells) {
    csv.text(cell.key.scenario).text(cell.key.pipeline).seed(cell.key.seed).text(cell.address);
    csv.text(to_string(cell.outcome.status)).text(cell.outcome.message).number(cell.outcome.wall_seconds);
    csv.number(cell.outcome.cpu_seconds).number(cell.outcome.peak_memory_bytes).number(cell.scan_seconds);
    csv.text(cell.result).integer(static_cast<long long>(cell.summary_size));
    part_fields(csv, cell.part);
    csv.end_row();
  }
  return csv.str();
}

std::vector<CommittedCell> cells_from(const CsvTable& csv) {
  std::vector<CommittedCell> cells;
  cells.reserve(csv.rows());
  std::size_t begin = summary_header().size();
  for (std::size_t r = 0; r < csv.rows(); ++r) {
    CommittedCell& cell = cells.emplace_back();
    cell.key = {csv.text(r, "scenario"), csv.text(r, "pipeline"), static_cast<std::uint64_t>(csv.integer(r, "seed"))};
    cell.address = csv.text(r, "address");
    cell.outcome = {.status = cell_status_from(csv.text(r, "status")),
                    .message = csv.text(r, "message"),
                    .wall_seconds = csv.number(r, "wall_seconds"),
                    .cpu_seconds = csv.number(r, "cpu_seconds"),
                    .peak_memory_bytes = csv.number(r, "peak_memory_bytes")};
    cell.scan_seconds = csv.number(r, "scan_seconds");
    cell.result = csv.text(r, "result");
    cell.part = part_from(csv, r);
    cell.summary_begin = begin;
    cell.summary_size = static_cast<std::size_t>(csv.integer(r, "summary_bytes"));
    begin += cell.summary_size;
  }
  return cells;
}

std::string checked_table(const fs::path& folder, const char* name, const Json& commit) {
  std::string bytes = read_file(folder / name);
  if (sha256_hex(bytes) != commit.at(name).get<std::string>())
    throw ConfigError((folder / name).string() + " is cut off or has been changed since it was committed");
  return bytes;
}

ShardCommit load_commit(const fs::path& folder) {
  const fs::path file = folder / kCommitFile;
  return with_json_of(file, [&](const Json& json) {
    if (json.at("schema") != 2 || json.at("program") != "scanbench")
      throw ConfigError(file.string() + ": not the commit of a shard, or one of another version");
    ShardCommit commit{folder, json.at("shard").get<int>(), json.at(kArchiveFile).get<std::string>(), {}, {}};
    checked_table(folder, "summary.csv", json);
    commit.cells = cells_from(CsvTable(checked_table(folder, kCellsFile, json), folder / kCellsFile, kCellColumns));
    const CsvTable recordings(checked_table(folder, kRecordingsFile, json), folder / kRecordingsFile,
                              kRecordingColumns);
    for (std::size_t r = 0; r < recordings.rows(); ++r)
      commit.recordings.push_back({recordings.text(r, "scenario"),
                                   static_cast<std::uint64_t>(recordings.integer(r, "seed")),
                                   recordings.text(r, "content_hash"), part_from(recordings, r)});
    return commit;
  });
}

}  // namespace

const CommittedRecording* ShardCommit::recording(const std::string& scenario, std::uint64_t seed) const {
  const auto found = std::ranges::lower_bound(recordings, std::pair(scenario, seed), {}, [](const auto& recording) {
    return std::pair(recording.scenario, recording.seed);
  });
  const bool is_listed = found != recordings.end() && found->scenario == scenario && found->seed == seed;
  return is_listed ? &*found : nullptr;
}

CommitWriter::CommitWriter(const fs::path& sweep, int number)
    : number_(number), staged_(stage_shard(sweep, number)), archive_(staged_.path() / kArchiveFile) {}

void CommitWriter::add_recording(const std::string& scenario, std::uint64_t seed, const FolderFiles& files) {
  if (has_recording(scenario, seed)) return;
  Recording recording;
  const auto scan = files.find(kScanFile.name());
  const nlohmann::json json = parsed_json(scan == files.end() ? "{}" : scan->second);
  if (json.is_object()) recording.scans = json.value("frames", 0.0);
  recording.committed = {scenario, seed, json.is_object() ? json.value("content_hash", "") : "",
                         archive_.add(recording_path("", scenario, seed), files)};
  recordings_.emplace(std::pair(scenario, seed), std::move(recording));
}

CommittedCell CommitWriter::add_cell(const CellKey& key, const std::string& address, const WorkerOutcome& outcome,
                                     const FolderFiles& files) {
  CommittedCell cell{
      .key = key, .address = address, .outcome = outcome, .scan_seconds = kNaN, .result = "", .part = {}};
  const auto recording = recordings_.find({key.scenario, key.seed});
  const auto timing = files.find(kTimingFile.name());
  if (recording != recordings_.end() && recording->second.scans > 0 && timing != files.end())
    cell.scan_seconds = sum_of_seconds(timing->second) / recording->second.scans;
  cell.result = repeatable_hash(files);
  cell.part = archive_.add(cell_path("", key), files);
  return cell;
}

fs::path CommitWriter::commit(const std::vector<CommittedCell>& cells, const std::string& summary) {
  CsvWriter recordings(kRecordingColumns);
  for (const auto& [key, recording] : recordings_) {
    recordings.text(key.first).seed(key.second).text(recording.committed.content_hash);
    part_fields(recordings, recording.committed.part);
    recordings.end_row();
  }
  const std::string tables[] = {cells_csv(cells), recordings.str(), summary};
  Json json{{"schema", 2}, {"program", "scanbench"}, {"shard", number_}, {"host", host_name()}};
  json[kArchiveFile] = archive_.finish();
  for (std::size_t i = 0; i < std::size(tables); ++i) {
    write_staged_file(path() / kTables[i], tables[i]);
    json[kTables[i]] = sha256_hex(tables[i]);
  }
  write_staged_file(path() / kCommitFile, json_text(json) + "\n");
  staged_.commit();
  return staged_.target();
}

ShardCommits load_commits(const fs::path& sweep, int number) {
  ShardCommits commits;
  for (const auto& name : names_in(shards_path(sweep))) {
    if (is_temporary_name(name)) ++commits.unfinished;
    const int shard = number_in_name(name);
    if (shard == 0 || (number != 0 && shard != number)) continue;
    try {
      commits.whole.push_back(load_commit(shards_path(sweep) / name));
    } catch (const ConfigError& e) {
      commits.damaged.emplace_back(name, e.what());
    }
  }
  return commits;
}

CommitCheck::Archive& CommitCheck::archive_of(const ShardCommit& commit) {
  const auto [known, is_new] = archives_.try_emplace(commit.folder.string());
  if (!is_new) return known->second;
  try {
    known->second.is_whole = sha256_of_file(commit.archive()) == commit.archive_sha256;
    known->second.reader.emplace(commit.archive());
  } catch (const ConfigError&) {
    known->second.is_whole = false;
  }
  return known->second;
}

bool CommitCheck::is_whole(const ShardCommit& commit, const CommittedCell& cell) {
  const Archive& archive = archive_of(commit);
  const bool has_recording = cell.outcome.status != CellStatus::skipped;
  if (has_recording && !is_whole(commit, cell.key.scenario, cell.key.seed)) return false;
  return archive.is_whole || (archive.reader && archive.reader->is_whole(cell.part));
}

bool CommitCheck::is_whole(const ShardCommit& commit, const std::string& scenario, std::uint64_t seed) {
  Archive& archive = archive_of(commit);
  const CommittedRecording* recording = commit.recording(scenario, seed);
  if (recording == nullptr || !archive.reader) return false;
  if (archive.is_whole) return true;
  const auto [known, is_new] = archive.recordings.try_emplace(recording->part.offset);
  if (is_new) known->second = archive.reader->is_whole(recording->part);
  return known->second;
}

std::string differing_file(const FolderFiles& a, const FolderFiles& b) {
  for (const auto& [name, bytes] : a) {
    const auto other = b.find(name);
    if (other == b.end() || repeatable_part(name, bytes) != repeatable_part(name, other->second)) return name;
  }
  for (const auto& [name, bytes] : b)
    if (!a.contains(name)) return name;
  return kStatusFile.name();
}

}  // namespace scanbench::harness
