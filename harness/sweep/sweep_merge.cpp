// Chooses an undamaged commit of every cell, and links its files into a run folder.
#include "harness/sweep/sweep_merge.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string_view>
#include <system_error>
#include <unordered_map>

#include "core/error.hpp"
#include "harness/files/atomic_file.hpp"
#include "harness/files/system_error.hpp"
#include "harness/run/runner.hpp"
#include "harness/store/cell_files.hpp"
#include "harness/store/manifest.hpp"
#include "harness/store/run_scenarios.hpp"
#include "harness/store/run_start.hpp"
#include "harness/store/run_target.hpp"
#include "harness/store/summary.hpp"
#include "harness/sweep/shard_commit.hpp"

namespace scanbench::harness {
namespace fs = std::filesystem;
namespace {

/// A cell in a commit.
struct Source {
  std::uint32_t commit = 0;
  std::uint32_t cell = 0;
};

/// True for outcomes that depend on the machine: another attempt at the same cell may be ok.
bool depends_on_machine(CellStatus status) {
  return status == CellStatus::timeout || status == CellStatus::out_of_memory || status == CellStatus::crashed ||
         status == CellStatus::skipped;
}

/// Files of both folders whose repeatable part differs, like "lines.csv"; timing.csv may differ.
std::string differing_file(const FolderHashes& a, const FolderHashes& b) {
  for (const auto& [name, hash] : a.files) {
    const auto other = b.files.find(name);
    if (other == b.files.end()) return name;
    const bool may_differ = name == kTimingFile.name() || name == kStatusFile.name();
    if (other->second != hash && !may_differ) return name;
  }
  for (const auto& [name, hash] : b.files)
    if (!a.files.contains(name)) return name;
  return kStatusFile.name();
}

class Merge {
 public:
  Merge(const SweepPlan& plan, const RunOptions& options)
      : plan_(plan), options_(options), commits_(load_commits(plan.folder)) {
    for (std::uint32_t c = 0; c < commits_.whole.size(); ++c)
      for (std::uint32_t i = 0; i < commits_.whole[c].cells.size(); ++i)
        sources_[commits_.whole[c].cells[i].address].push_back({c, i});
  }

  MergeResult merge() {
    MergeResult result;
    result.missing = choose();
    if (result.missing) return result;
    RunTarget target(options_.out, false);
    Manifest manifest = begin(target.path());
    link_all(target.path());
    write_file_atomically(target.path() / kSummaryFile, summary());
    result.run = outcome();
    manifest.verified = std::move(hashes_);
    const std::string state = "complete";
    end_run(target, manifest, state, options_.finish != nullptr);
    finish_run(result.run, state, options_);
    return result;
  }

 private:
  const ShardCommit& commit_of(const Source& source) const { return commits_.whole[source.commit]; }
  const CommittedCell& cell_of(const Source& source) const { return commit_of(source).cells[source.cell]; }

  /// Finds an undamaged commit of every cell; returns the cells that have none.
  std::optional<MissingCells> choose() {
    MissingCells missing;
    std::set<int> shards;
    std::set<std::string> damaged;
    for (const auto& [name, fault] : commits_.damaged) missing.notes.push_back(fault);
    for (const SweepCell& cell : plan_.cells) {
      const auto chosen = choose(cell, damaged);
      chosen_.push_back(chosen.value_or(Source{}));
      if (chosen) continue;
      ++missing.count;
      if (cell.shard == 0)
        ++missing.lost;
      else
        shards.insert(cell.shard);
    }
    missing.shards.assign(shards.begin(), shards.end());
    for (const auto& folder : damaged)
      missing.notes.push_back(folder + " has a file that is cut off or has been changed since it was committed");
    return missing.count > 0 ? std::optional(missing) : std::nullopt;
  }

  std::optional<Source> choose(const SweepCell& cell, std::set<std::string>& damaged) {
    std::optional<Source> best;
    FolderHashes best_hashes;
    const auto found = sources_.find(cell.address);
    if (found == sources_.end()) return std::nullopt;
    for (const Source& source : found->second) {
      FolderHashes hashes;
      if (!check_.is_whole(commit_of(source), cell_of(source), &hashes)) {
        damaged.insert(cell_path(commit_of(source).folder, cell.key).string());
        continue;
      }
      if (best && !is_better(source, *best)) {
        require_equal(cell, *best, best_hashes, source, hashes);
        continue;
      }
      best = source;
      best_hashes = std::move(hashes);
    }
    if (!best) return std::nullopt;
    const fs::path folder = cell_path("", cell.key);
    for (const auto& [name, hash] : best_hashes.files) hashes_.emplace((folder / name).generic_string(), hash);
    return best;
  }

  /// An attempt that was ok counts before one that the machine stopped.
  bool is_better(const Source& a, const Source& b) const {
    return cell_of(a).status != cell_of(b).status && depends_on_machine(cell_of(b).status) &&
           !depends_on_machine(cell_of(a).status);
  }

  void require_equal(const SweepCell& cell, const Source& a, const FolderHashes& a_hashes, const Source& b,
                     const FolderHashes& b_hashes) const {
    const CommittedCell& first = cell_of(a);
    const CommittedCell& second = cell_of(b);
    const bool by_machine = first.status != second.status && depends_on_machine(second.status);
    if (by_machine || first.result == second.result) return;
    throw ConfigError("the cell " + to_string(cell.key) + " was committed twice with different " +
                      differing_file(a_hashes, b_hashes) + ": " + commit_of(a).folder.string() + " and " +
                      commit_of(b).folder.string() +
                      "; equal cells must have equal bytes on every machine (times aside). Remove the wrong folder");
  }

  Manifest begin(const fs::path& run) const {
    std::vector<CellKey> keys;
    for (const SweepCell& cell : plan_.cells) keys.push_back(cell.key);
    Manifest manifest{"running", utc_now(), "", options_.argv, plan_.scenarios, std::move(keys)};
    make_folders(run);
    write_manifest(run, manifest);  // with it the folder is ours
    for (const auto& file : scenario_files(plan_.folder, plan_.scenarios)) {
      make_folders((run / file).parent_path());
      write_file_atomically(run / file, read_file(plan_.folder / file));
    }
    return manifest;
  }

  void link_all(const fs::path& run) {
    std::map<std::pair<std::string, std::uint64_t>, std::uint32_t> recordings;  // the commit of each
    for (std::size_t i = 0; i < plan_.cells.size(); ++i) {
      const ShardCommit& commit = commit_of(chosen_[i]);
      const CellKey& key = plan_.cells[i].key;
      link_folder(cell_path(commit.folder, key), cell_path(run, key));
      if (cell_of(chosen_[i]).status == CellStatus::skipped) continue;
      const auto [known, is_new] = recordings.try_emplace({key.scenario, key.seed}, chosen_[i].commit);
      if (is_new)
        link_recording(run, commit, key);
      else if (known->second != chosen_[i].commit)
        require_equal_recordings(commits_.whole[known->second], commit, key);
    }
  }

  void link_recording(const fs::path& run, const ShardCommit& commit, const CellKey& key) {
    link_folder(recording_path(commit.folder, key.scenario, key.seed), recording_path(run, key.scenario, key.seed));
    const fs::path folder = recording_path("", key.scenario, key.seed);
    for (const auto& [name, hash] : check_.recording(commit, key.scenario, key.seed)->files)
      hashes_.emplace((folder / name).generic_string(), hash);
  }

  void require_equal_recordings(const ShardCommit& a, const ShardCommit& b, const CellKey& key) {
    const FolderHashes* first = check_.recording(a, key.scenario, key.seed);
    const FolderHashes* second = check_.recording(b, key.scenario, key.seed);
    if (first->whole == second->whole) return;
    throw ConfigError("the recording " + key.scenario + "/" + std::to_string(key.seed) +
                      " was committed twice with different " + differing_file(*first, *second) + ": " +
                      a.folder.string() + " and " + b.folder.string() + "; remove the wrong folder");
  }

  void link_folder(const fs::path& from, const fs::path& to) {
    make_folders(to);
    for (const auto& entry : fs::directory_iterator(from)) {
      const fs::path target = to / entry.path().filename();
      std::error_code error;
      if (links_) fs::create_hard_link(entry.path(), target, error);
      if (links_ && !error) continue;
      links_ = false;
      fs::copy_file(entry.path(), target, error);
      if (error)
        throw SystemError("cannot copy " + entry.path().string() + " to " + target.string() + ": " + error.message());
    }
  }

  std::string summary() const {
    std::string text = summary_header();
    std::map<std::uint32_t, std::string> tables;  // by commit
    for (const Source& source : chosen_) {
      const auto [table, is_new] = tables.try_emplace(source.commit);
      if (is_new) table->second = read_file(commit_of(source).folder / kSummaryFile);
      text.append(table->second, cell_of(source).summary_begin, cell_of(source).summary_size);
    }
    return text;
  }

  RunResult outcome() const {
    RunResult result;
    result.out = options_.out.lexically_normal();
    for (std::size_t i = 0; i < plan_.cells.size(); ++i) {
      CellResult& cell = result.cells.emplace_back();
      cell.key = plan_.cells[i].key;
      cell.done = true;
      cell.record.address = plan_.cells[i].address;
      cell.record.outcome.status = cell_of(chosen_[i]).status;
      if (cell.record.outcome.status != CellStatus::ok)
        cell.record = load_status(cell_path(commit_of(chosen_[i]).folder, cell.key));
    }
    return result;
  }

  const SweepPlan& plan_;
  const RunOptions& options_;
  ShardCommits commits_;
  std::unordered_map<std::string_view, std::vector<Source>> sources_;  ///< by address
  std::vector<Source> chosen_;                                         ///< by cell of the plan
  std::map<std::string, std::string> hashes_;                          ///< of the run's files, by path
  CommitCheck check_;
  bool links_ = true;  ///< the file system has them
};

}  // namespace

MergeResult merge_sweep(const SweepPlan& plan, const RunOptions& options) {
  require_this_program(plan);
  return Merge(plan, options).merge();
}

}  // namespace scanbench::harness
