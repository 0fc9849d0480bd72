// Writes, reads and checks the folders that shards commit.
#include "harness/sweep/shard_commit.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <set>

#include <unistd.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "harness/files/csv.hpp"
#include "harness/files/folder.hpp"
#include "harness/files/hash.hpp"
#include "harness/store/cell_files.hpp"
#include "harness/store/json_file.hpp"
#include "harness/store/summary.hpp"

namespace scanbench::harness {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;
using Columns = std::vector<std::string>;

constexpr const char* kCommitFile = "commit.json";
constexpr const char* kCellsFile = "cells.csv";
constexpr const char* kRecordingsFile = "recordings.csv";
constexpr const char* kTables[] = {kCellsFile, kRecordingsFile, "summary.csv"};

const Columns kCellColumns{"scenario", "pipeline", "seed", "address", "status", "whole", "result", "summary_bytes"};
const Columns kRecordingColumns{"scenario", "seed", "whole"};

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

/// The part of a file that must be equal each time it is made.
std::string repeatable_hash(const fs::path& file, const std::string& hash) {
  const std::string name = file.filename().string();
  if (name == kTimingFile.name()) return "";
  if (name == kMetricsFile.name()) return sha256_hex(without_times(read_file(file)));
  if (name == kStatusFile.name()) return std::string(to_string(load_status(file.parent_path()).outcome.status));
  return hash;
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

std::string checked_table(const fs::path& folder, const char* name, const Json& commit) {
  const std::string bytes = read_file(folder / name);
  if (sha256_hex(bytes) != commit.at(name).get<std::string>())
    throw ConfigError((folder / name).string() + " is cut off or has been changed since it was committed");
  return bytes;
}

ShardCommit load_commit(const fs::path& folder) {
  const fs::path file = folder / kCommitFile;
  return with_json_of(file, [&](const Json& json) {
    if (json.at("schema") != 1 || json.at("program") != "scanbench")
      throw ConfigError(file.string() + ": not the commit of a shard");
    ShardCommit commit{folder, json.at("shard").get<int>(), {}, {}};
    checked_table(folder, "summary.csv", json);
    const CsvTable cells(checked_table(folder, kCellsFile, json), folder / kCellsFile, kCellColumns);
    std::size_t begin = summary_header().size();
    for (std::size_t r = 0; r < cells.rows(); ++r) {
      const auto bytes = static_cast<std::size_t>(cells.integer(r, "summary_bytes"));
      commit.cells.push_back(
          {{cells.text(r, "scenario"), cells.text(r, "pipeline"), static_cast<std::uint64_t>(cells.integer(r, "seed"))},
           cells.text(r, "address"),
           cell_status_from(cells.text(r, "status")),
           cells.text(r, "whole"),
           cells.text(r, "result"),
           begin,
           bytes});
      begin += bytes;
    }
    const CsvTable recordings(checked_table(folder, kRecordingsFile, json), folder / kRecordingsFile,
                              kRecordingColumns);
    for (std::size_t r = 0; r < recordings.rows(); ++r)
      commit.recordings.push_back({recordings.text(r, "scenario"),
                                   static_cast<std::uint64_t>(recordings.integer(r, "seed")),
                                   recordings.text(r, "whole")});
    return commit;
  });
}

}  // namespace

FolderHashes hash_folder(const fs::path& folder) {
  FolderHashes hashes;
  Sha256 whole, result;
  for (const auto& name : names_in(folder)) {
    const std::string hash = sha256_of_file(folder / name);
    whole.part(name, hash);
    result.part(name, repeatable_hash(folder / name, hash));
    hashes.files.emplace(name, hash);
  }
  hashes.whole = whole.hex();
  hashes.result = result.hex();
  return hashes;
}

StagedFolder stage_shard(const fs::path& sweep, int number) {
  const std::string unique = unique_name();
  const fs::path target = shards_path(sweep) / (std::to_string(number) + "." + unique);
  return {target, shards_path(sweep) / ("." + std::to_string(number) + ".tmp-" + unique)};
}

void commit_shard(StagedFolder& staged, int number, std::vector<CommittedCell> cells, const std::string& summary) {
  const fs::path& folder = staged.path();
  CsvWriter cell_table(kCellColumns), recording_table(kRecordingColumns);
  std::set<std::pair<std::string, std::uint64_t>> recordings;
  for (auto& cell : cells) {
    const FolderHashes hashes = hash_folder(cell_path(folder, cell.key));
    cell_table.text(cell.key.scenario)
        .text(cell.key.pipeline)
        .seed(cell.key.seed)
        .text(cell.address)
        .text(to_string(cell.status))
        .text(hashes.whole)
        .text(hashes.result)
        .integer(static_cast<long long>(cell.summary_size))
        .end_row();
    recordings.emplace(cell.key.scenario, cell.key.seed);
  }
  for (const auto& [scenario, seed] : recordings) {
    const fs::path recording = recording_path(folder, scenario, seed);
    if (!fs::exists(recording)) continue;  // it could not be made, and its cells are skipped
    recording_table.text(scenario).seed(seed).text(hash_folder(recording).whole).end_row();
  }
  const std::string tables[] = {cell_table.str(), recording_table.str(), summary};
  Json json{{"schema", 1}, {"program", "scanbench"}, {"shard", number}, {"host", host_name()}};
  for (std::size_t i = 0; i < std::size(tables); ++i) {
    write_staged_file(folder / kTables[i], tables[i]);
    json[kTables[i]] = sha256_hex(tables[i]);
  }
  write_staged_file(folder / kCommitFile, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  staged.commit();
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

bool CommitCheck::is_whole(const ShardCommit& commit, const CommittedCell& cell, FolderHashes* hashes) {
  try {
    FolderHashes found = hash_folder(cell_path(commit.folder, cell.key));
    if (found.whole != cell.whole) return false;
    const bool has_recording = cell.status != CellStatus::skipped;
    if (has_recording && recording(commit, cell.key.scenario, cell.key.seed) == nullptr) return false;
    if (hashes != nullptr) *hashes = std::move(found);
    return true;
  } catch (const ConfigError&) {
    return false;
  }
}

const FolderHashes* CommitCheck::recording(const ShardCommit& commit, const std::string& scenario, std::uint64_t seed) {
  const fs::path folder = recording_path(commit.folder, scenario, seed);
  const auto [known, is_new] = recordings_.try_emplace(folder.string());
  if (is_new) {
    const auto committed = std::ranges::lower_bound(  // the table is sorted
        commit.recordings, std::pair(scenario, seed), {},
        [](const CommittedRecording& r) { return std::pair(r.scenario, r.seed); });
    const bool is_listed =
        committed != commit.recordings.end() && committed->scenario == scenario && committed->seed == seed;
    try {
      if (is_listed) known->second = hash_folder(folder);
      if (!is_listed || known->second.whole != committed->whole) known->second = {};
    } catch (const ConfigError&) {
      known->second = {};
    }
  }
  return known->second.whole.empty() ? nullptr : &known->second;
}

}  // namespace scanbench::harness
