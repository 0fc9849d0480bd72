// Runs scenarios: reuses what an earlier run has, executes the other cells, and writes the summary and the manifest.
#include "harness/runs/execute/runner.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/system_error.hpp"
#include "harness/runs/execute/execution.hpp"
#include "harness/runs/execute/folder_sink.hpp"
#include "harness/runs/execute/make_recording.hpp"
#include "harness/runs/execute/resume.hpp"
#include "harness/runs/execute/run_plan.hpp"
#include "harness/runs/execute/summary_rows.hpp"
#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/run_start.hpp"
#include "harness/runs/store/run_target.hpp"
#include "harness/runs/store/summary.hpp"
#include "harness/runs/store/written_hashes.hpp"
#include "harness/study/scenario/effective.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;
namespace {

class Run {
 public:
  Run(const std::vector<study::Scenario>& scenarios, const RunOptions& options, const RunServices& services)
      : scenarios_(scenarios),
        options_(options),
        services_(services),
        plan_(plan_run(scenarios, options)),
        execution_(plan_, options.jobs, services.recording,
                   {.ended = [this](std::size_t cell, CellResult result,
                                    const std::string& summary) { end_cell(cell, std::move(result), summary); },
                    .began_recording = [this](const std::string& what) { tell_progress(what, nullptr); },
                    .pause = [this] { write_summary_now_and_then(); }}),
        cells_(plan_.cells.size()),
        summary_(plan_.cells.size()) {
    target_ = std::make_unique<RunTarget>(options.out, options.resume || !options.only.empty());
    if (target_->resumed()) earlier_.emplace(target_->path());
  }

  RunResult execute() {
    reuse_finished_cells();
    refuse_to_drop_cells();
    write_start();
    tell_progress("", nullptr);
    FolderSink sink(target_->path(), written_);
    execution_.work(sink);
    refuse_if_all_input_is_bad();
    RunResult result = end();
    execution_.release();
    if (!result.interrupted && !result.old_run_kept) finish_run(result, manifest_.state, options_);
    return result;
  }

 private:
  void write_start() {
    std::vector<CellKey> keys;
    for (const auto& cell : plan_.cells) keys.push_back(plan_.key(cell));
    manifest_ =
        start_run(*target_, {scenarios_, std::move(keys), options_.argv, options_.rules, services_.effective_yaml});
    manifest_.cells = {};  // until the end, because each child gets a copy
  }

  CellKey key_of(std::size_t cell) const { return plan_.key(plan_.cells[cell]); }

  /// Cells of an earlier run that are ok and have the same address are kept; the others of the selection wait to be
  /// run. Cells outside the selection only add their rows to the summary.
  void reuse_finished_cells() {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const bool is_selected = selected(options_, key_of(i));
      if (earlier_ && (options_.resume || !is_selected)) try_to_reuse(i);
      if (!is_selected) continue;
      ++total_;
      if (cells_[i])
        ++done_;
      else
        execution_.add(i);
    }
  }

  /// A selection keeps the other cells of the earlier run. Cells of other input or of another build cannot be kept, but
  /// must not be lost, so the run is refused.
  void refuse_to_drop_cells() {
    if (!earlier_ || options_.only.empty()) return;
    std::string first;
    std::size_t count = 0;
    std::set<CellKey> kept;
    for (std::size_t i = 0; i < cells_.size(); ++i)
      if (cells_[i] || selected(options_, key_of(i))) kept.insert(key_of(i));
    for (const CellKey& key : load_manifest(target_->path()).cells) {
      if (kept.contains(key)) continue;
      if (!earlier_->is_ok(key)) continue;
      if (count++ == 0) first = to_string(key);
    }
    if (count > 0)
      throw ConfigError(options_.out.string() + " contains an earlier run, and --only cannot keep " +
                        std::to_string(count) + " of its cells (" + first +
                        " is the first), because the input, the parameters or the program differ; run all cells, or "
                        "choose another folder");
  }

  void try_to_reuse(std::size_t index) {
    const PlannedCell& planned = plan_.cells[index];
    CellResult cell{.key = key_of(index), .done = true, .reused = true, .record = {}};
    const auto found =
        earlier_->find(cell.key, plan_.address(planned), *plan_.works[planned.work].pipeline, plan_.trace(planned));
    if (!found) return;
    summary_.set(index, summary_lines(cell.key, found->metrics));
    cell.record = found->record;
    cells_[index] = std::make_unique<CellResult>(std::move(cell));
  }

  void end_cell(std::size_t index, CellResult result, const std::string& summary) {
    summary_.set(index, summary);
    cells_[index] = std::make_unique<CellResult>(std::move(result));
    ++done_;
    tell_progress(to_string(cells_[index]->key), cells_[index].get());
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
    } catch (const io::SystemError&) {
    }
    const auto ended = std::chrono::steady_clock::now();
    next_summary_ =
        ended + std::max<std::chrono::steady_clock::duration>(std::chrono::seconds(1), 50 * (ended - begun));
  }

  void write_summary() const { io::write_file_atomically(target_->path() / kSummaryFile, summary_.text()); }

  void refuse_if_all_input_is_bad() {
    const bool any_reused = std::ranges::any_of(cells_, [](const auto& cell) { return cell && cell->reused; });
    const std::string message = execution_.only_bad_input();
    if (execution_.interrupted() || message.empty() || any_reused) return;
    target_->abandon();
    throw ConfigError(message);
  }

  RunResult end() {
    RunResult result{.out = options_.out.lexically_normal(), .cells = {}, .interrupted = execution_.interrupted()};
    bool missing = false;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (!selected(options_, key_of(i))) continue;
      result.cells.push_back(cells_[i] ? std::move(*cells_[i]) : CellResult{.key = key_of(i), .record = {}});
      missing = missing || !result.cells.back().done;
    }
    result.old_run_kept = (missing || result.interrupted) && target_->replaces();
    if (result.old_run_kept) {
      target_->abandon();
      return result;
    }
    write_summary();
    for (std::size_t i = 0; i < cells_.size(); ++i) manifest_.cells.push_back(key_of(i));
    manifest_.verified = verified_files();
    const std::string state = result.interrupted ? "interrupted" : missing ? "incomplete" : "complete";
    end_run(*target_, manifest_, state, options_.finish && state == "complete");
    return result;
  }

  /// Files of reused cells and recordings, and of those that were written. A recording may have been made again for
  /// other cells.
  std::map<std::string, std::string> verified_files() {
    std::map<std::string, std::string> files = written_.take();
    if (!earlier_) return files;
    std::map<std::string, std::string> earlier = earlier_->verified();
    for (std::size_t i = 0; i < plan_.groups.size(); ++i) {
      if (!execution_.has_work(i)) continue;
      const fs::path folder = recording_path("", plan_.groups[i].scenario->name, plan_.groups[i].seed);
      std::erase_if(earlier, [prefix = folder.generic_string() + "/"](const auto& file) {
        return file.first.starts_with(prefix);
      });
    }
    files.merge(earlier);
    return files;
  }

  const std::vector<study::Scenario>& scenarios_;
  const RunOptions& options_;
  const RunServices& services_;
  RunPlan plan_;
  WrittenHashes written_;
  Execution execution_;  ///< destroyed late, so that no interrupt comes before the unfinished run is removed
  std::unique_ptr<RunTarget> target_;
  std::optional<EarlierCells> earlier_;  ///< of a run that is resumed
  /// In the order of the plan; those that have ended. Each child gets a copy, so that they are made when needed.
  std::vector<std::unique_ptr<CellResult>> cells_;
  SummaryRows summary_;
  std::size_t done_ = 0;
  std::size_t total_ = 0;
  Manifest manifest_;
  std::chrono::steady_clock::time_point next_summary_{};
};

}  // namespace

void finish_run(const RunResult& result, const std::string& state, const RunOptions& options) {
  if (!options.finish) return;
  const bool is_complete = state == "complete";
  try {
    options.finish(result);
  } catch (...) {
    if (is_complete) set_run_state(result.out, "interrupted");
    throw;
  }
  if (is_complete) set_run_state(result.out, state);
}

RunResult run_with(const std::vector<study::Scenario>& scenarios, const RunOptions& options,
                   const RunServices& services) {
  return Run(scenarios, options, services).execute();
}

RunResult run(const std::vector<study::Scenario>& scenarios, const RunOptions& options) {
  return run_with(scenarios, options,
                  {.recording = [](const study::Scenario& s, std::uint64_t seed,
                                   int threads) { return make_recording(s, seed, threads); },
                   .effective_yaml = study::effective_yaml});
}

}  // namespace scanbench::runs
