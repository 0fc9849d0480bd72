// Chooses an undamaged commit of every cell, and makes a run folder of their files or of their archives.
#include "harness/runs/sweep/sweep_merge.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string_view>
#include <system_error>
#include <unordered_map>

#include "core/error.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/hash.hpp"
#include "harness/io/files/input_file.hpp"
#include "harness/io/files/system_error.hpp"
#include "harness/runs/execute/runner.hpp"
#include "harness/runs/store/archived_run.hpp"
#include "harness/runs/store/cell_files.hpp"
#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/run_scenarios.hpp"
#include "harness/runs/store/run_start.hpp"
#include "harness/runs/store/run_target.hpp"
#include "harness/runs/store/summary.hpp"
#include "harness/runs/sweep/shard_commit.hpp"

namespace scanbench::runs {
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

FolderFiles files_of(const ShardCommit& commit, const ArchivePart& part, const fs::path& folder) {
  return ArchiveReader(commit.archive()).files(part, folder);
}

/// The name of a commit's archive in a run folder.
std::string archive_name(const ShardCommit& commit) {
  return commit.folder.filename().string() + ".tar";
}

class Merge {
 public:
  Merge(const SweepPlan& plan, const RunOptions& options, CellForm form)
      : plan_(plan),
        options_(options),
        as_archives_(form == CellForm::archives ||
                     (form == CellForm::automatic && plan.cells.size() > kMostCellsAsFiles)),
        commits_(load_commits(plan.folder)) {
    for (std::uint32_t c = 0; c < commits_.whole.size(); ++c)
      for (std::uint32_t i = 0; i < commits_.whole[c].table.cells.size(); ++i)
        sources_[commits_.whole[c].table.cells[i].record.address].push_back({c, i});
  }

  MergedSweep merge() {
    MergedSweep result;
    result.missing = choose();
    if (result.missing) return result;
    choose_recordings();
    RunTarget target(options_.out, false);
    try {
      write(target);
    } catch (...) {
      target.abandon();
      throw;
    }
    result.run = outcome();
    finish_run(result.run, "complete", options_);
    return result;
  }

 private:
  using RecordingKey = std::pair<std::string, std::uint64_t>;

  const ShardCommit& commit_of(const Source& source) const { return commits_.whole[source.commit]; }
  const ArchivedCell& cell_of(const Source& source) const { return commit_of(source).table.cells[source.cell]; }

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
    for (const auto& archive : damaged)
      missing.notes.push_back(archive + " is cut off or has been changed since it was committed");
    return missing.count > 0 ? std::optional(missing) : std::nullopt;
  }

  std::optional<Source> choose(const SweepCell& cell, std::set<std::string>& damaged) {
    std::optional<Source> best;
    const auto found = sources_.find(cell.address);
    if (found == sources_.end()) return std::nullopt;
    for (const Source& source : found->second) {
      if (!check_.is_whole(commit_of(source), cell_of(source))) {
        damaged.insert(commit_of(source).archive().string());
        continue;
      }
      if (best && !is_better(source, *best))
        require_equal(cell, *best, source);
      else
        best = source;
    }
    return best;
  }

  /// An attempt that was ok counts before one that the machine stopped.
  bool is_better(const Source& a, const Source& b) const {
    const CellStatus first = cell_of(a).record.outcome.status, second = cell_of(b).record.outcome.status;
    return first != second && depends_on_machine(second) && !depends_on_machine(first);
  }

  void require_equal(const SweepCell& cell, const Source& a, const Source& b) const {
    const ArchivedCell& first = cell_of(a);
    const ArchivedCell& second = cell_of(b);
    const CellStatus status = second.record.outcome.status;
    const bool by_machine = first.record.outcome.status != status && depends_on_machine(status);
    if (by_machine || first.result == second.result) return;
    const fs::path folder = cell_path("", cell.key);
    throw ConfigError(
        "the cell " + to_string(cell.key) + " was committed twice with different " +
        differing_file(files_of(commit_of(a), first.part, folder), files_of(commit_of(b), second.part, folder)) + ": " +
        commit_of(a).folder.string() + " and " + commit_of(b).folder.string() +
        "; equal cells must have equal bytes on every machine (times aside). Remove the wrong folder");
  }

  /// Takes each recording from the commit of its first cell; those of the others must be equal.
  void choose_recordings() {
    for (std::size_t i = 0; i < plan_.cells.size(); ++i) {
      const CellKey& key = plan_.cells[i].key;
      if (cell_of(chosen_[i]).record.outcome.status == CellStatus::skipped) continue;
      const auto [known, is_new] = recordings_.try_emplace({key.scenario, key.seed}, chosen_[i].commit);
      if (!is_new && known->second != chosen_[i].commit)
        require_equal_recordings(commits_.whole[known->second], commit_of(chosen_[i]), known->first);
    }
  }

  static void require_equal_recordings(const ShardCommit& a, const ShardCommit& b, const RecordingKey& key) {
    const ArchivePart& first = a.table.recording(key.first, key.second)->part;
    const ArchivePart& second = b.table.recording(key.first, key.second)->part;
    if (first.sha256 == second.sha256) return;
    const fs::path folder = recording_path("", key.first, key.second);
    throw ConfigError("the recording " + key.first + "/" + std::to_string(key.second) +
                      " was committed twice with different " +
                      differing_file(files_of(a, first, folder), files_of(b, second, folder)) + ": " +
                      a.folder.string() + " and " + b.folder.string() + "; remove the wrong folder");
  }

  void write(RunTarget& target) {
    Manifest manifest = begin(target.path());
    if (as_archives_)
      write_archives(target.path());
    else
      write_files(target.path(), [](const CellKey&) { return true; });
    io::write_file_atomically(target.path() / kSummaryFile, summary());
    io::flush_file_system(target.path());
    manifest.verified = std::move(hashes_);
    end_run(target, manifest, "complete", options_.finish != nullptr);
  }

  Manifest begin(const fs::path& run) const {
    std::vector<CellKey> keys;
    for (const SweepCell& cell : plan_.cells) keys.push_back(cell.key);
    Manifest manifest{"running", utc_now(), "", options_.argv, plan_.scenarios, std::move(keys)};
    io::make_folders(run);
    write_manifest(run, manifest);  // with it the folder is ours
    for (const auto& file : scenario_files(plan_.folder, plan_.scenarios)) {
      io::make_folders((run / file).parent_path());
      io::write_file_atomically(run / file, io::read_file(plan_.folder / file));
    }
    note_foreign_modules(manifest, load_run_scenarios(run, plan_.scenarios));
    return manifest;
  }

  /// Writes the folders of the wanted cells and of their recordings.
  template <class Wanted>
  void write_files(const fs::path& run, Wanted wanted) {
    std::map<std::uint32_t, ArchiveReader> readers;  // by commit
    const auto write_folder = [&](std::uint32_t commit, const ArchivePart& part, const fs::path& folder) {
      const auto reader = readers.try_emplace(commit, commits_.whole[commit].archive()).first;
      io::make_folders(run / folder);
      for (const auto& [name, bytes] : reader->second.files(part, folder)) {
        io::write_staged_file(run / folder / name, bytes);
        hashes_.emplace((folder / name).generic_string(), io::sha256_hex(bytes));
      }
    };
    std::set<RecordingKey> written;
    for (std::size_t i = 0; i < plan_.cells.size(); ++i) {
      const CellKey& key = plan_.cells[i].key;
      if (!wanted(key)) continue;
      write_folder(chosen_[i].commit, cell_of(chosen_[i]).part, cell_path("", key));
      const auto recording = recordings_.find({key.scenario, key.seed});
      if (recording == recordings_.end() || !written.insert(recording->first).second) continue;
      const ShardCommit& commit = commits_.whole[recording->second];
      write_folder(recording->second, commit.table.recording(key.scenario, key.seed)->part,
                   recording_path("", key.scenario, key.seed));
    }
  }

  void write_archives(const fs::path& run) {
    io::make_folders(run / "archives");
    CellTable table;
    std::set<std::uint32_t> commits;
    table.cells.reserve(plan_.cells.size());
    for (std::size_t i = 0; i < plan_.cells.size(); ++i) {
      commits.insert(chosen_[i].commit);
      table.cells.push_back(cell_of(chosen_[i]));
      table.cells.back().archive = archive_name(commit_of(chosen_[i]));
    }
    for (const auto& [key, c] : recordings_) {
      table.recordings.push_back(*commits_.whole[c].table.recording(key.first, key.second));
      table.recordings.back().archive = archive_name(commits_.whole[c]);
    }
    for (const std::uint32_t c : commits) link_archive(run, commits_.whole[c]);
    write_archive_tables(run, table);
    write_first_seeds(run);
  }

  void link_archive(const fs::path& run, const ShardCommit& commit) {
    const fs::path target = archive_path(run, archive_name(commit));
    std::error_code error;
    fs::create_hard_link(commit.archive(), target, error);
    if (error) fs::copy_file(commit.archive(), target, error);
    if (error)
      throw io::SystemError("cannot copy " + commit.archive().string() + " to " + target.string() + ": " +
                            error.message());
    if (check_.is_whole(commit)) hashes_.emplace("archives/" + archive_name(commit), commit.archive_sha256);
  }

  void write_first_seeds(const fs::path& run) {
    std::map<std::string, std::uint64_t> first;
    std::size_t cells = 0;
    for (const SweepCell& cell : plan_.cells)
      cells += first.try_emplace(cell.key.scenario, cell.key.seed).first->second == cell.key.seed ? 1 : 0;
    if (cells > kMostCellsAsFiles) return;
    write_files(run, [&](const CellKey& key) { return first.at(key.scenario) == key.seed; });
  }

  std::string summary() const {
    std::string text = summary_header();
    std::map<std::uint32_t, io::InputFile> tables;  // by commit
    for (const Source& source : chosen_) {
      const auto table = tables.try_emplace(source.commit, commit_of(source).folder / kSummaryFile).first;
      const ArchivedCell& cell = cell_of(source);
      const std::size_t begin = text.size();
      text.resize(begin + cell.summary_size);
      if (table->second.read_at(cell.summary_begin, std::span(text).subspan(begin)) < cell.summary_size)
        throw ConfigError(table->second.path().string() + " was cut off while it was read");
    }
    return text;
  }

  RunResult outcome() const {
    RunResult result;
    result.out = options_.out.lexically_normal();
    result.cells.reserve(plan_.cells.size());
    for (std::size_t i = 0; i < plan_.cells.size(); ++i) {
      CellResult& cell = result.cells.emplace_back();
      cell.key = plan_.cells[i].key;
      cell.done = true;
      cell.record = {cell_of(chosen_[i]).record.outcome, plan_.cells[i].address};
    }
    return result;
  }

  const SweepPlan& plan_;
  const RunOptions& options_;
  bool as_archives_;
  ShardCommits commits_;
  std::unordered_map<std::string_view, std::vector<Source>> sources_;  ///< by address
  std::vector<Source> chosen_;                                         ///< by cell of the plan
  std::map<RecordingKey, std::uint32_t> recordings_;                   ///< the commit of each
  std::map<std::string, std::string> hashes_;                          ///< of the run's files, by path
  CommitCheck check_;
};

}  // namespace

MergedSweep merge_sweep(const SweepPlan& plan, const RunOptions& options, CellForm form) {
  require_this_program(plan);
  return Merge(plan, options, form).merge();
}

}  // namespace scanbench::runs
