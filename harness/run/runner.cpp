// Schedules a run: cells form groups that share a recording, and at most `jobs` children run at once.
#include "harness/run/runner.hpp"

#include <algorithm>
#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "harness/files/atomic_file.hpp"
#include "harness/files/system_error.hpp"
#include "harness/run/cell_work.hpp"
#include "harness/run/make_recording.hpp"
#include "harness/run/resume.hpp"
#include "harness/run/run_plan.hpp"
#include "harness/run/worker.hpp"
#include "harness/scenario/effective.hpp"
#include "harness/store/cell_status.hpp"
#include "harness/store/manifest.hpp"
#include "harness/store/recording_folder.hpp"
#include "harness/store/run_start.hpp"
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
    target_ = std::make_unique<RunTarget>(options.out, options.resume || !options.only.empty());
    if (target_->resumed()) earlier_.emplace(target_->path());
  }

  RunResult execute() {
    try {
      reuse_finished_cells();
      refuse_to_drop_cells();
      write_start();
      tell_progress("", nullptr);
      work();
    } catch (...) {
      pool_->kill_all();  // before the folders that the children write are removed
      throw;
    }
    const bool interrupted = pool_->interrupted();
    pool_->kill_all();
    refuse_if_all_input_is_bad(interrupted);
    RunResult result = end(interrupted);
    pool_.reset();  // from here on the caller handles interrupts
    if (!interrupted && !result.old_run_kept) finish_run(result);
    return result;
  }

 private:
  Group& group_of(const Cell& cell) { return groups_[cell.plan.group]; }

  void work() {
    while (!pool_->interrupted()) {
      while (pool_->running() < static_cast<std::size_t>(options_.jobs) && start_next()) {
      }
      if (pool_->running() == 0) break;
      for (auto& finished : pool_->wait()) {
        if (finished.id < cells_.size())
          finish_cell(cells_[finished.id], finished.outcome);
        else
          finish_recording(groups_[finished.id - cells_.size()], finished.outcome);
      }
      write_summary_now_and_then();
    }
  }

  void write_start() {
    std::vector<CellKey> keys;
    for (const auto& cell : cells_) keys.push_back(cell.result.key);
    manifest_ =
        start_run(*target_, {scenarios_, std::move(keys), options_.argv, options_.rules, services_.effective_yaml});
  }

  /// Cells of an earlier run that are ok and have the same address are kept; the others of the selection wait to be
  /// run. Cells outside the selection only add their rows to the summary.
  void reuse_finished_cells() {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      Cell& cell = cells_[i];
      const bool is_selected = selected(options_, cell.result.key);
      if (earlier_ && (options_.resume || !is_selected)) try_to_reuse(cell);
      if (!is_selected) continue;
      ++total_;
      if (cell.result.reused) {
        ++done_;
      } else {
        group_of(cell).waiting.push_back(i);
        ++group_of(cell).unfinished;
      }
    }
  }

  /// A selection keeps the other cells of the earlier run. Cells of other input or of another build cannot be kept, but
  /// must not be lost, so the run is refused.
  void refuse_to_drop_cells() {
    if (!earlier_ || options_.only.empty()) return;
    std::string first;
    std::size_t count = 0;
    for (const CellKey& key : load_manifest(target_->path()).cells) {
      const auto cell = std::ranges::find(cells_, key, [](const Cell& c) { return c.result.key; });
      if (cell != cells_.end() && (cell->result.reused || selected(options_, key))) continue;
      if (!earlier_->is_ok(key)) continue;
      if (count++ == 0) first = to_string(key);
    }
    if (count > 0)
      throw ConfigError(options_.out.string() + " contains an earlier run, and --only cannot keep " +
                        std::to_string(count) + " of its cells (" + first +
                        " is the first), because the input, the parameters or the program differ; run all cells, or "
                        "choose another folder");
  }

  void try_to_reuse(Cell& cell) {
    const auto found =
        earlier_->find(cell.result.key, cell.result.record.address, *cell.plan.pipeline, cell.plan.trace);
    if (!found) return;
    cell.summary = summary_lines(cell.result.key, found->metrics);
    cell.result.record = found->record;
    cell.result.done = cell.result.reused = true;
  }

  /// Figures and reports belong to the run: it is complete when they exist. Killed before, it is still running, as any
  /// other run that was killed.
  void finish_run(const RunResult& result) {
    if (!options_.finish) return;
    const bool is_complete = manifest_.state == "complete";
    try {
      options_.finish(result);
    } catch (...) {
      if (is_complete) set_run_state(result.out, "interrupted");
      throw;
    }
    if (is_complete) set_run_state(result.out, manifest_.state);
  }

  /// Starts a cell whose recording exists, else the next recording. False if there is nothing to start now.
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
      skip_cells(group, {.message = e.what(), .system_error = true});
      return;
    }
    const int threads = std::max(1, options_.jobs - static_cast<int>(pool_->running()));
    tell_progress("recording " + group.plan.scenario->name + "/" + std::to_string(group.plan.seed), nullptr);
    try {
      pool_->start(cells_.size() + index,
                   [&] {
                     return write_recording(group.staged->path(),
                                            services_.recording(*group.plan.scenario, group.plan.seed, threads));
                   },
                   {group.plan.scenario->limits.seconds, group.plan.scenario->limits.memory_bytes, threads});
    } catch (const SystemError& e) {
      group.staged.reset();
      skip_cells(group, {.message = e.what(), .system_error = true});
    }
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
      } catch (const SystemError& e) {
        outcome = {.message = e.what(), .system_error = true};
      } catch (const std::exception& e) {
        outcome = {.status = CellStatus::failed, .message = e.what()};
      }
    }
    group.staged.reset();
    skip_cells(group, outcome);
  }

  void skip_cells(Group& group, const WorkerOutcome& outcome) {
    if (outcome.bad_input && first_bad_input_.empty()) first_bad_input_ = outcome.message;
    has_other_failure_ = has_other_failure_ || !outcome.bad_input;
    const std::string message =
        "there is no recording: " + std::string(to_string(outcome.status)) + ": " + outcome.message;
    for (const std::size_t index : group.waiting) {
      Cell& cell = cells_[index];
      if (outcome.system_error)
        mark_missing(cell, outcome.message);
      else if (stage(cell))
        finish_cell(cell, {.status = CellStatus::skipped, .message = message});
    }
  }

  /// The new recording replaces the old one only if it differs.
  static void place_recording(Group& group, const std::string& hash) {
    try {
      if (recording_hash(load_recording(group.staged->target())) == hash) return;
    } catch (const std::exception&) {
      // The old recording is missing or damaged.
    }
    group.staged->commit();
  }

  void start_cell(std::size_t index) {
    Cell& cell = cells_[index];
    const Scenario& scenario = *cell.plan.scenario;
    has_other_failure_ = true;
    if (!stage(cell)) return;
    try {
      pool_->start(index,
                   [&] {
                     return make_cell(cell.staged->path(), scenario, *cell.plan.pipeline, cell.plan.trace,
                                      *group_of(cell).recording);
                   },
                   {scenario.limits.seconds, scenario.limits.memory_bytes, 1});
    } catch (const SystemError& e) {
      mark_missing(cell, e.what());
    }
  }

  void finish_cell(Cell& cell, const WorkerOutcome& outcome) {
    if (outcome.system_error) {
      mark_missing(cell, outcome.message);
      return;
    }
    cell.result.record.outcome = outcome;
    try {
      if (outcome.status != CellStatus::ok) cell.staged->clear();
      if (outcome.status == CellStatus::ok)
        cell.summary = summary_lines(cell.result.key, load_metrics(cell.staged->path()));
      write_staged_file(cell.staged->path() / kStatusFile, status_json(cell.result.record));
      cell.staged->commit();
      cell.result.done = true;
    } catch (const ConfigError& e) {
      mark_missing(cell, e.what());
      return;
    }
    finish(cell);
  }

  /// Makes the unfinished folder of a cell. If that fails, marks the cell as missing and returns false.
  bool stage(Cell& cell) {
    try {
      cell.staged.emplace(cell_path(target_->path(), cell.result.key));
      return true;
    } catch (const ConfigError& e) {
      mark_missing(cell, e.what());
      return false;
    }
  }

  /// Marks a cell as missing after a failure of the system, like a full disk. The run is then incomplete, but other
  /// cells may succeed.
  void mark_missing(Cell& cell, const std::string& reason) {
    cell.result.record.outcome.status = CellStatus::failed;
    cell.result.record.outcome.message = reason;
    cell.result.done = false;
    cell.summary.clear();
    finish(cell);
  }

  void finish(Cell& cell) {
    cell.staged.reset();
    ++done_;
    Group& group = group_of(cell);
    if (--group.unfinished == 0) group.recording.reset();
    tell_progress(to_string(cell.result.key), &cell.result);
  }

  void tell_progress(const std::string& what, const CellResult* cell) const {
    if (options_.progress) options_.progress({done_, total_, what, cell});
  }

  /// Writes the summary at most once a second, and for at most a fiftieth of the time: that of 10^5 cells has 60 MB. A
  /// full disk does not stop the run, because only the last summary counts.
  void write_summary_now_and_then() {
    const auto begun = std::chrono::steady_clock::now();
    if (begun < next_summary_) return;
    try {
      write_summary();
    } catch (const SystemError&) {
    }
    const auto ended = std::chrono::steady_clock::now();
    next_summary_ =
        ended + std::max<std::chrono::steady_clock::duration>(std::chrono::seconds(1), 50 * (ended - begun));
  }

  void write_summary() {
    std::string text = summary_header();
    for (const auto& cell : cells_) text += cell.summary;
    write_file_atomically(target_->path() / kSummaryFile, text);
  }

  void refuse_if_all_input_is_bad(bool interrupted) {
    const bool any_reused = std::ranges::any_of(cells_, [](const Cell& c) { return c.result.reused; });
    if (interrupted || first_bad_input_.empty() || has_other_failure_ || any_reused) return;
    target_->abandon();
    throw ConfigError(first_bad_input_);
  }

  RunResult end(bool interrupted) {
    RunResult result{.out = options_.out.lexically_normal(), .cells = {}, .interrupted = interrupted};
    bool missing = false;
    for (auto& cell : cells_) {
      cell.staged.reset();
      if (!selected(options_, cell.result.key)) continue;
      missing = missing || !cell.result.done;
      result.cells.push_back(cell.result);
    }
    for (auto& group : groups_) group.staged.reset();
    result.old_run_kept = (missing || interrupted) && target_->replaces();
    if (result.old_run_kept) {
      target_->abandon();
      return result;
    }
    write_summary();
    const std::string state = interrupted ? "interrupted" : missing ? "incomplete" : "complete";
    end_run(*target_, manifest_, state, options_.finish && state == "complete");
    return result;
  }

  const std::vector<Scenario>& scenarios_;
  const RunOptions& options_;
  const RunServices& services_;
  std::optional<WorkerPool> pool_{
      std::in_place};  ///< destroyed last, so that an interrupt cannot come before unfinished files are removed
  std::vector<Group> groups_;
  std::unique_ptr<RunTarget> target_;
  std::optional<EarlierCells> earlier_;  ///< of a run that is resumed
  std::vector<Cell> cells_;              ///< after target_: unfinished folders are removed before the run's folder
  std::deque<std::size_t> ready_;
  std::size_t next_group_ = 0;
  std::size_t done_ = 0;
  std::size_t total_ = 0;
  Manifest manifest_;
  std::string first_bad_input_;
  bool has_other_failure_ = false;  ///< a cell was started, or something failed for another reason than bad input
  std::chrono::steady_clock::time_point next_summary_{};
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
