// The schedule of a run: groups of cells that share a recording, at most `jobs` children at once.
#include "harness/run/runner.hpp"

#include <algorithm>
#include <chrono>
#include <deque>
#include <memory>
#include <optional>

#include "core/error.hpp"
#include "harness/files/atomic_file.hpp"
#include "harness/run/cell_work.hpp"
#include "harness/run/make_recording.hpp"
#include "harness/run/resume.hpp"
#include "harness/run/run_plan.hpp"
#include "harness/run/worker.hpp"
#include "harness/scenario/benchmark_spec.hpp"
#include "harness/scenario/effective.hpp"
#include "harness/store/cell_status.hpp"
#include "harness/store/manifest.hpp"
#include "harness/store/recording_folder.hpp"
#include "harness/store/run_files.hpp"
#include "harness/store/run_target.hpp"
#include "harness/store/summary.hpp"

namespace scanbench::harness {
namespace fs = std::filesystem;
namespace {

/// A recording, and the cells that wait for it.
struct Group {
  PlannedGroup plan;
  std::vector<std::size_t> waiting;  ///< indices of cells to run
  std::size_t unfinished = 0;
  std::optional<StagedFolder> staged;  ///< while the recording is made
  std::optional<Recording> recording;  ///< while cells need it
};

struct Cell {
  PlannedCell plan;
  CellResult result;
  std::string summary;  ///< its lines of summary.csv
  std::optional<StagedFolder> staged;
};

class Run {
 public:
  Run(const std::vector<Scenario>& scenarios, const RunOptions& options, const RunServices& services)
      : scenarios_(scenarios), options_(options), services_(services) {
    RunPlan plan = plan_run(scenarios, options);
    for (const auto& group : plan.groups) groups_.emplace_back().plan = group;
    for (auto& planned : plan.cells) {
      Cell& cell = cells_.emplace_back();
      cell.result.key = planned.key;
      cell.result.record.address = planned.address;
      cell.plan = std::move(planned);
    }
    target_ = std::make_unique<RunTarget>(options.out, options.resume);
    if (target_->resumed()) standing_.emplace(target_->path());
  }

  RunResult execute() {
    try {
      write_start();
      reuse_finished_cells();
      work();
    } catch (...) {
      pool_.kill_all();  // before the folders that the children write go
      throw;
    }
    const bool interrupted = pool_.interrupted();
    pool_.kill_all();
    refuse_if_all_input_is_bad(interrupted);
    return end(interrupted);
  }

 private:
  Group& group_of(const Cell& cell) { return groups_[cell.plan.group]; }

  void work() {
    while (!pool_.interrupted()) {
      while (pool_.running() < static_cast<std::size_t>(options_.jobs) && start_next()) {
      }
      if (pool_.running() == 0) break;
      for (auto& finished : pool_.wait()) {
        if (finished.id < cells_.size())
          finish_cell(cells_[finished.id], finished.outcome);
        else
          finish_recording(groups_[finished.id - cells_.size()], finished.outcome);
      }
      write_summary(false);
    }
  }

  void write_start() {
    const fs::path& run = target_->path();
    manifest_.state = "running";
    manifest_.start = utc_now();
    manifest_.argv = options_.argv;
    for (const auto& scenario : scenarios_) manifest_.scenarios.push_back(scenario.name);
    for (const auto& cell : cells_) manifest_.cells.push_back(cell.result.key);
    write_manifest(run, manifest_);  // first of all files: with it the folder is ours
    if (options_.benchmark) write_file_atomically(run / "benchmark.json", benchmark_json(*options_.benchmark));
    write_run_scenarios(run, scenarios_, services_.effective_yaml);
  }

  /// Cells that stand there with the same address and are ok stay; the others of the selection wait to be run. Cells
  /// outside the selection only lend their rows to the summary.
  void reuse_finished_cells() {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      Cell& cell = cells_[i];
      if (standing_) try_to_reuse(cell);
      if (!selected(options_, cell.result.key)) continue;
      ++total_;
      if (cell.result.reused) {
        ++done_;
      } else {
        group_of(cell).waiting.push_back(i);
        ++group_of(cell).unfinished;
      }
    }
    report("", nullptr);
  }

  void try_to_reuse(Cell& cell) {
    const auto found =
        standing_->find(cell.result.key, cell.result.record.address, *cell.plan.pipeline, cell.plan.trace);
    if (!found) return;
    cell.summary = summary_lines(cell.result.key, found->metrics);
    cell.result.record = found->record;
    cell.result.done = cell.result.reused = true;
  }

  /// A cell whose recording is there, else the next recording. False if there is nothing to start now.
  bool start_next() {
    if (!ready_.empty()) {
      const std::size_t index = ready_.front();
      ready_.pop_front();
      start_cell(index);
      return true;
    }
    while (next_group_ < groups_.size()) {
      const std::size_t index = next_group_++;
      if (groups_[index].unfinished == 0) continue;
      start_recording(index);
      return true;
    }
    return false;
  }

  void start_recording(std::size_t index) {
    Group& group = groups_[index];
    try {
      group.staged.emplace(recording_path(target_->path(), group.plan.scenario->name, group.plan.seed));
    } catch (const ConfigError& e) {
      skip_cells(group, {.message = e.what()});
      return;
    }
    const int threads = std::max(1, options_.jobs - static_cast<int>(pool_.running()));
    report("recording " + group.plan.scenario->name + "/" + std::to_string(group.plan.seed), nullptr);
    pool_.start(cells_.size() + index,
                [&] {
                  return write_recording(group.staged->path(),
                                         services_.recording(*group.plan.scenario, group.plan.seed, threads));
                },
                {group.plan.scenario->limits.seconds, group.plan.scenario->limits.memory_bytes, threads});
  }

  void finish_recording(Group& group, WorkerOutcome outcome) {
    const fs::path folder = group.staged->target();
    if (outcome.status == CellStatus::ok) {
      try {
        place_recording(group, outcome.message);
        group.recording = load_recording(folder);
        ready_.insert(ready_.end(), group.waiting.begin(), group.waiting.end());
        group.staged.reset();
        return;
      } catch (const std::exception& e) {
        outcome = {.status = CellStatus::failed, .message = e.what()};
      }
    }
    group.staged.reset();
    skip_cells(group, outcome);
  }

  void skip_cells(Group& group, const WorkerOutcome& outcome) {
    if (outcome.bad_input && first_bad_input_.empty()) first_bad_input_ = outcome.message;
    other_trouble_ = other_trouble_ || !outcome.bad_input;
    const std::string message =
        "there is no recording: " + std::string(to_string(outcome.status)) + ": " + outcome.message;
    for (const std::size_t index : group.waiting) {
      if (stage(cells_[index])) finish_cell(cells_[index], {.status = CellStatus::skipped, .message = message});
    }
  }

  /// The new recording takes the old one's place only if it is another one.
  static void place_recording(Group& group, const std::string& hash) {
    try {
      if (recording_hash(load_recording(group.staged->target())) == hash) return;
    } catch (const std::exception&) {
      // None there, or damaged.
    }
    group.staged->commit();
  }

  void start_cell(std::size_t index) {
    Cell& cell = cells_[index];
    const Scenario& scenario = *cell.plan.scenario;
    other_trouble_ = true;
    if (!stage(cell)) return;
    pool_.start(index,
                [&] {
                  return make_cell(cell.staged->path(), scenario, *cell.plan.pipeline, cell.plan.trace,
                                   *group_of(cell).recording);
                },
                {scenario.limits.seconds, scenario.limits.memory_bytes, 1});
  }

  void finish_cell(Cell& cell, const WorkerOutcome& outcome) {
    cell.result.record.outcome = outcome;
    try {
      if (outcome.status != CellStatus::ok) cell.staged->clear();
      if (outcome.status == CellStatus::ok)
        cell.summary = summary_lines(cell.result.key, load_metrics(cell.staged->path()));
      write_staged_file(cell.staged->path() / "status.json", status_json(cell.result.record));
      cell.staged->commit();
      cell.result.done = true;
    } catch (const ConfigError& e) {
      give_up(cell, e.what());
    }
    leave(cell);
  }

  /// Makes the cell's folder under construction. False: it cannot be made, and the cell is missing.
  bool stage(Cell& cell) {
    try {
      cell.staged.emplace(cell_path(target_->path(), cell.result.key));
      return true;
    } catch (const ConfigError& e) {
      give_up(cell, e.what());
      leave(cell);
      return false;
    }
  }

  /// The disk is full, say: the cell is missing and the run incomplete, but the others may still succeed.
  static void give_up(Cell& cell, const std::string& reason) {
    cell.result.record.outcome.status = CellStatus::failed;
    cell.result.record.outcome.message = reason;
    cell.summary.clear();
  }

  void leave(Cell& cell) {
    cell.staged.reset();
    ++done_;
    Group& group = group_of(cell);
    if (--group.unfinished == 0) group.recording.reset();
    report(to_string(cell.result.key), &cell.result);
  }

  void report(const std::string& what, const CellResult* cell) const {
    if (options_.progress) options_.progress({done_, total_, what, cell});
  }

  /// At most once a second while cells come in; the last call writes in any case.
  void write_summary(bool last) {
    const auto now = std::chrono::steady_clock::now();
    if (!last && now - summary_written_ < std::chrono::seconds(1)) return;
    summary_written_ = now;
    std::string text = summary_header();
    for (const auto& cell : cells_) text += cell.summary;
    write_file_atomically(target_->path() / "summary.csv", text);
  }

  void refuse_if_all_input_is_bad(bool interrupted) {
    const bool any_reused = std::ranges::any_of(cells_, [](const Cell& c) { return c.result.reused; });
    if (interrupted || first_bad_input_.empty() || other_trouble_ || any_reused) return;
    target_->abandon();
    throw ConfigError(first_bad_input_);
  }

  RunResult end(bool interrupted) {
    RunResult result{.out = options_.out, .cells = {}, .interrupted = interrupted};
    for (auto& cell : cells_) {
      cell.staged.reset();
      if (selected(options_, cell.result.key)) result.cells.push_back(cell.result);
    }
    for (auto& group : groups_) group.staged.reset();
    write_summary(true);
    manifest_.state = interrupted ? "interrupted" : "complete";
    manifest_.end = utc_now();
    write_manifest(target_->path(), manifest_);
    if (!interrupted) target_->finish();
    return result;
  }

  const std::vector<Scenario>& scenarios_;
  const RunOptions& options_;
  const RunServices& services_;
  WorkerPool pool_;  ///< lives longest: no interrupt comes between us and the removal of what is not finished
  std::vector<Group> groups_;
  std::unique_ptr<RunTarget> target_;
  std::optional<StandingCells> standing_;  ///< of a run that is resumed
  std::vector<Cell> cells_;                ///< after target_: unfinished folders go before the run's folder does
  std::deque<std::size_t> ready_;
  std::size_t next_group_ = 0;
  std::size_t done_ = 0;
  std::size_t total_ = 0;
  Manifest manifest_;
  std::string first_bad_input_;
  bool other_trouble_ = false;  ///< something was tried, or failed, for another reason than bad input
  std::chrono::steady_clock::time_point summary_written_{};
};

}  // namespace

RunResult run_with(const std::vector<Scenario>& scenarios, const RunOptions& options, const RunServices& services) {
  return Run(scenarios, options, services).execute();
}

RunResult run(const std::vector<Scenario>& scenarios, const RunOptions& options) {
  return run_with(
      scenarios, options,
      {.recording = [](const Scenario& s, std::uint64_t seed, int threads) { return make_recording(s, seed, threads); },
       .effective_yaml = effective_yaml});
}

}  // namespace scanbench::harness
