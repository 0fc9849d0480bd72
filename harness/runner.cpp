// The schedule of a run: groups of cells that share a recording, at most `jobs` children at once.
#include "harness/runner.hpp"

#include <algorithm>
#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "core/error.hpp"
#include "harness/atomic_file.hpp"
#include "harness/figures.hpp"
#include "harness/pipeline.hpp"
#include "harness/recording_folder.hpp"
#include "harness/resume.hpp"
#include "harness/score.hpp"

namespace scanbench::harness {
namespace fs = std::filesystem;
namespace {

/// The cells of one scenario and seed, and the recording that they share.
struct Group {
  const Scenario* scenario = nullptr;
  std::uint64_t seed = 0;
  std::vector<std::size_t> waiting;  ///< indices of cells to run
  std::size_t unfinished = 0;
  std::optional<StagedFolder> staged;  ///< while the recording is made
  std::optional<Recording> recording;  ///< while cells need it
};

struct Cell {
  CellResult result;
  const Scenario* scenario = nullptr;
  const PipelineSpec* pipeline = nullptr;
  Group* group = nullptr;
  TraceChoice trace;    ///< what of it is kept
  std::string summary;  ///< its lines of summary.csv
  std::optional<StagedFolder> staged;
};

void check_scenarios(const std::vector<Scenario>& scenarios, const RunOptions& options) {
  std::set<std::string> names;
  if (options.jobs < 1) throw ConfigError("jobs is " + std::to_string(options.jobs) + "; allowed: 1 or more");
  for (const auto& scenario : scenarios) {
    check_name("scenario", scenario.name);
    if (!names.insert(scenario.name).second)
      throw ConfigError("two scenarios have the name '" + scenario.name + "'; each needs a folder of its own");
    std::set<std::string> pipelines;
    for (const auto& pipeline : scenario.pipelines) {
      check_name("pipeline", pipeline.name);
      if (!pipelines.insert(pipeline.name).second)
        throw ConfigError("scenario '" + scenario.name + "': two pipelines have the name '" + pipeline.name + "'");
    }
  }
  for (const auto& only : options.only) {
    std::string known;
    bool found = false;
    for (const auto& scenario : scenarios) {
      known += (known.empty() ? "" : ", ") + scenario.name;
      found = found || only == scenario.name;
      for (const auto& pipeline : scenario.pipelines) {
        known += ", " + scenario.name + "/" + pipeline.name;
        found = found || only == pipeline.name || only == scenario.name + "/" + pipeline.name;
      }
    }
    if (!found) throw ConfigError("nothing is named '" + only + "' here; known: " + known);
  }
}

bool selected(const RunOptions& options, const CellKey& key) {
  return options.only.empty() || std::ranges::any_of(options.only, [&](const std::string& only) {
           return only == key.scenario || only == key.pipeline || only == key.scenario + "/" + key.pipeline;
         });
}

class Run {
 public:
  Run(const std::vector<Scenario>& scenarios, const RunOptions& options, const RunServices& services)
      : scenarios_(scenarios), options_(options), services_(services) {
    check_scenarios(scenarios, options);
    plan();
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
  void work() {
    while (!pool_.interrupted()) {
      while (pool_.running() < static_cast<std::size_t>(options_.jobs) && start_next()) {
      }
      if (pool_.running() == 0) break;
      for (auto& finished : pool_.wait()) {
        if (finished.id < cells_.size())
          finish_cell(cells_[finished.id], finished.outcome);
        else
          finish_recording(*groups_[finished.id - cells_.size()], finished.outcome);
      }
      write_summary(false);
    }
  }

  void plan() {
    for (const auto& scenario : scenarios_) {
      const std::string input = input_address(scenario);
      const auto& seeds = options_.seeds.empty() ? scenario.seeds : options_.seeds;
      std::vector<Group*> groups;
      for (const std::uint64_t seed : seeds) {
        if (std::ranges::count(seeds, seed) > 1)
          throw ConfigError("the seed " + std::to_string(seed) + " is given twice");
        groups_.push_back(std::make_unique<Group>());
        groups_.back()->scenario = &scenario;
        groups_.back()->seed = seed;
        groups.push_back(groups_.back().get());
      }
      for (const auto& pipeline : scenario.pipelines) {
        const TraceChoice drawn = traces_drawn(scenario, pipeline.name);
        for (Group* group : groups) {
          Cell cell;
          cell.result.key = {scenario.name, pipeline.name, group->seed};
          // Figures show the first seed.
          cell.trace = options_.journal               ? TraceChoice{.all = true}
                       : group->seed == seeds.front() ? drawn
                                                      : TraceChoice{};
          cell.result.record.address = cell_address(input, scenario.metrics, pipeline, group->seed, cell.trace);
          cell.scenario = &scenario;
          cell.pipeline = &pipeline;
          cell.group = group;
          cells_.push_back(std::move(cell));
        }
      }
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
    if (scenarios_.size() == 1) {
      write_file_atomically(run / "scenario.yaml", scenarios_.front().text);
      write_file_atomically(run / "effective.yaml", services_.effective_yaml(scenarios_.front()));
      return;
    }
    make_folders(run / "scenarios");
    make_folders(run / "effective");
    for (const auto& scenario : scenarios_) {
      write_file_atomically(run / "scenarios" / (scenario.name + ".yaml"), scenario.text);
      write_file_atomically(run / "effective" / (scenario.name + ".yaml"), services_.effective_yaml(scenario));
    }
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
        cell.group->waiting.push_back(i);
        ++cell.group->unfinished;
      }
    }
    report("", nullptr);
  }

  void try_to_reuse(Cell& cell) {
    const auto found = standing_->find(cell.result.key, cell.result.record.address, *cell.pipeline, cell.trace);
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
      if (groups_[index]->unfinished == 0) continue;
      start_recording(index);
      return true;
    }
    return false;
  }

  void start_recording(std::size_t index) {
    Group& group = *groups_[index];
    try {
      group.staged.emplace(recording_path(target_->path(), group.scenario->name, group.seed));
    } catch (const ConfigError& e) {
      skip_cells(group, {.message = e.what()});
      return;
    }
    const int threads = std::max(1, options_.jobs - static_cast<int>(pool_.running()));
    report("recording " + group.scenario->name + "/" + std::to_string(group.seed), nullptr);
    pool_.start(cells_.size() + index,
                [&] {
                  return write_recording(group.staged->path(),
                                         services_.recording(*group.scenario, group.seed, threads));
                },
                {group.scenario->limits.seconds, group.scenario->limits.memory_bytes, threads});
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
    other_trouble_ = true;
    if (!stage(cell)) return;
    pool_.start(index,
                [&] {
                  const fs::path& folder = cell.staged->path();
                  Journal journal(cell.trace);
                  const bool traced = !cell.trace.nothing();
                  const Recording& recording = *cell.group->recording;
                  const PipelineRun run = run_pipeline(*cell.pipeline, recording.observed, traced ? &journal : nullptr);
                  write_result(folder, *cell.pipeline, run.result);
                  if (traced) write_staged_file(folder / "trace.csv", journal.csv());
                  const Scores scores = score_cell(cell.scenario->metrics, recording, folder);
                  write_staged_file(folder / "metrics.csv", metrics_csv(scores.rows));
                  for (const auto& table : scores.tables)
                    write_staged_file(folder / (table.name + ".csv"), metric_table_csv(table));
                  return run.remarks;
                },
                {cell.scenario->limits.seconds, cell.scenario->limits.memory_bytes, 1});
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
    if (--cell.group->unfinished == 0) cell.group->recording.reset();
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
    for (auto& group : groups_) group->staged.reset();
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
  std::vector<std::unique_ptr<Group>> groups_;
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

int RunResult::exit_code() const {
  if (interrupted) return 130;
  if (std::ranges::any_of(cells, [](const CellResult& c) { return !c.done; })) return 4;
  if (std::ranges::any_of(cells, [](const CellResult& c) { return c.record.outcome.status != CellStatus::ok; }))
    return 3;
  return 0;
}

RunResult run_with(const std::vector<Scenario>& scenarios, const RunOptions& options, const RunServices& services) {
  return Run(scenarios, options, services).execute();
}

}  // namespace scanbench::harness
