// Writes, reads and checks the folders that shards commit.
#include "harness/runs/sweep/shard_commit.hpp"

#include <algorithm>
#include <charconv>

#include <unistd.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/special_values.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/csv.hpp"
#include "harness/io/files/folder.hpp"
#include "harness/io/files/hash.hpp"
#include "harness/io/files/json.hpp"
#include "harness/runs/store/cell_files.hpp"
#include "harness/runs/store/json_file.hpp"
#include "harness/runs/store/recording_folder.hpp"
#include "harness/runs/store/summary.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kCommitFile = "commit.json";
constexpr const char* kArchiveFile = "cells.tar";

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
  const nlohmann::json json = io::parsed_json(bytes);
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
  io::Sha256 hash;
  for (const auto& [name, bytes] : files) hash.part(name, repeatable_part(name, bytes));
  return hash.hex();
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

io::StagedFolder stage_shard(const fs::path& sweep, int number) {
  const std::string unique = io::unique_name();
  const fs::path target = shards_path(sweep) / (std::to_string(number) + "." + unique);
  return {target, shards_path(sweep) / ("." + std::to_string(number) + ".tmp-" + unique)};
}

std::string checked_table(const fs::path& folder, const std::string& name, const Json& commit) {
  std::string bytes = io::read_file(folder / name);
  if (io::sha256_hex(bytes) != commit.at(name).get<std::string>())
    throw ConfigError((folder / name).string() + " is cut off or has been changed since it was committed");
  return bytes;
}

ShardCommit load_commit(const fs::path& folder) {
  const fs::path file = folder / kCommitFile;
  return with_json_of(file, [&](const Json& json) {
    if (json.at("schema") != 2 || json.at("program") != "scanbench")
      throw ConfigError(file.string() + ": not the commit of a shard, or one of another version");
    checked_table(folder, kSummaryFile.name(), json);
    return ShardCommit{folder, json.at("shard").get<int>(), json.at(kArchiveFile).get<std::string>(),
                       parse_cell_table(checked_table(folder, kCellTable.name(), json),
                                        checked_table(folder, kRecordingTable.name(), json), folder)};
  });
}

}  // namespace

CommitWriter::CommitWriter(const fs::path& sweep, int number)
    : number_(number), staged_(stage_shard(sweep, number)), archive_(staged_.path() / kArchiveFile) {}

void CommitWriter::add_recording(const std::string& scenario, std::uint64_t seed, const FolderFiles& files) {
  if (has_recording(scenario, seed)) return;
  Recording recording;
  const auto scan = files.find(kScanFile.name());
  const nlohmann::json json = io::parsed_json(scan == files.end() ? "{}" : scan->second);
  if (json.is_object()) recording.scans = json.value("frames", 0.0);
  recording.archived = {scenario, seed, json.is_object() ? json.value("content_hash", "") : "", kArchiveFile,
                        archive_.add(recording_path("", scenario, seed), files)};
  recordings_.emplace(std::pair(scenario, seed), std::move(recording));
}

ArchivedCell CommitWriter::add_cell(const CellKey& key, const CellRecord& record, const FolderFiles& files) {
  ArchivedCell cell{.key = key,
                    .record = record,
                    .scan_seconds = kNaN,
                    .result = repeatable_hash(files),
                    .summary_begin = 0,
                    .summary_size = 0,
                    .archive = kArchiveFile,
                    .part = {}};
  const auto recording = recordings_.find({key.scenario, key.seed});
  const auto timing = files.find(kTimingFile.name());
  if (recording != recordings_.end() && recording->second.scans > 0 && timing != files.end())
    cell.scan_seconds = stage_seconds({timing->second, kTimingFile.name(), {"seconds"}}) / recording->second.scans;
  cell.part = archive_.add(cell_path("", key), files);
  return cell;
}

fs::path CommitWriter::commit(const std::vector<ArchivedCell>& cells, const std::string& summary) {
  std::vector<ArchivedRecording> recordings;
  for (const auto& [key, recording] : recordings_) recordings.push_back(recording.archived);
  const std::pair<std::string, std::string> tables[] = {{kCellTable.name(), cells_csv(cells)},
                                                        {kRecordingTable.name(), recordings_csv(recordings)},
                                                        {kSummaryFile.name(), summary}};
  Json json{{"schema", 2}, {"program", "scanbench"}, {"shard", number_}, {"host", host_name()}};
  json[kArchiveFile] = archive_.finish();
  for (const auto& [name, bytes] : tables) {
    io::write_staged_file(path() / name, bytes);
    json[name] = io::sha256_hex(bytes);
  }
  io::write_staged_file(path() / kCommitFile, io::json_text(json) + "\n");
  staged_.commit();
  return staged_.target();
}

ShardCommits load_commits(const fs::path& sweep, int number) {
  ShardCommits commits;
  for (const auto& name : io::names_in(shards_path(sweep))) {
    if (io::is_temporary_name(name)) ++commits.unfinished;
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

std::unordered_set<std::string> committed_addresses(const fs::path& sweep, int number) {
  std::unordered_set<std::string> addresses;
  CommitCheck check;
  for (const ShardCommit& commit : load_commits(sweep, number).whole)
    for (const ArchivedCell& cell : commit.table.cells)
      if (!addresses.contains(cell.record.address) && check.is_whole(commit, cell))
        addresses.insert(cell.record.address);
  return addresses;
}

CommitCheck::Archive& CommitCheck::archive_of(const ShardCommit& commit) {
  const auto [known, is_new] = archives_.try_emplace(commit.folder.string());
  if (!is_new) return known->second;
  try {
    known->second.is_whole = io::sha256_of_file(commit.archive()) == commit.archive_sha256;
    known->second.reader.emplace(commit.archive());
  } catch (const ConfigError&) {
    known->second.is_whole = false;
  }
  return known->second;
}

bool CommitCheck::is_whole(const ShardCommit& commit, const ArchivedCell& cell) {
  const Archive& archive = archive_of(commit);
  const bool has_recording = cell.record.outcome.status != CellStatus::skipped;
  if (has_recording && !is_whole(commit, cell.key.scenario, cell.key.seed)) return false;
  return archive.is_whole || (archive.reader && archive.reader->is_whole(cell.part));
}

bool CommitCheck::is_whole(const ShardCommit& commit, const std::string& scenario, std::uint64_t seed) {
  Archive& archive = archive_of(commit);
  const ArchivedRecording* recording = commit.table.recording(scenario, seed);
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

}  // namespace scanbench::runs
