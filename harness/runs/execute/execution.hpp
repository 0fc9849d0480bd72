// Executes planned cells: makes each recording once, and runs each of its cells in a child process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/recording.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/runs/execute/cell_sink.hpp"
#include "harness/runs/execute/run_options.hpp"
#include "harness/runs/execute/run_plan.hpp"
#include "harness/runs/execute/worker.hpp"
#include "harness/runs/store/cell_status.hpp"

namespace scanbench::runs {

using MakeRecording = std::function<Recording(const study::Scenario&, std::uint64_t seed, int threads)>;

/// What the owner of an execution hears of.
struct ExecutionEvents {
  /// A cell has ended: the sink has kept it, and these are its lines of summary.csv, or it is missing.
  std::function<void(std::size_t cell, CellResult result, const std::string& summary)> ended;
  std::function<void(const std::string& what)> began_recording;
  std::function<void()> pause;  ///< between two cells
};

/// Recordings and cells have the paths that recording_path() and cell_path() name.
class Execution {
 public:
  /// Blocks interrupts (worker.hpp), until release(). `plan` must remain.
  Execution(const RunPlan& plan, int jobs, MakeRecording make_recording, ExecutionEvents events);

  /// Adds a cell to those that work() runs.
  void add(std::size_t cell);

  /// Runs the cells at once and puts them into the sink. After an interrupt, it kills the children that still run after
  /// `grace_seconds` and returns; the sink has kept the finished cells. Throws what the events throw; then no child
  /// runs any more.
  void work(CellSink& sink, double grace_seconds = 0.0);

  bool interrupted() const { return interrupted_; }
  bool terminated() const { return terminated_; }  ///< by SIGTERM
  /// True if cells of this recording were added.
  bool has_work(std::size_t group) const { return !groups_[group].cells.empty(); }
  /// The message of the first input that cannot be read; empty if there is none, or a cell was started, or something
  /// else failed.
  std::string only_bad_input() const { return has_other_failure_ ? "" : first_bad_input_; }
  /// From here on, the caller handles interrupts.
  void release() { pool_.reset(); }

 private:
  struct ActiveGroup {
    std::optional<io::StagedFolder> files;  ///< while the recording is made
    std::optional<Recording> recording;     ///< while cells need it, if several do
  };
  struct Group {
    std::vector<std::size_t> cells;
    std::size_t unfinished = 0;
    std::unique_ptr<ActiveGroup> active;  ///< while cells run; a plan may have 10^5 groups
  };

  void prepare_metrics() const;
  void run_all(double grace_seconds);
  void take(WorkerPool::Finished finished);
  bool start_next();
  void start_recording(std::size_t index);
  void start_children(std::size_t index, std::optional<io::StagedFolder> cell_folder);
  TaskOutput work_on_recording(std::size_t index, int threads, std::optional<Recording>& made) const;
  TaskOutput work_on_cell(std::size_t cell, const std::filesystem::path& folder, const Recording& recording) const;
  void finish_recording(std::size_t index, WorkerOutcome outcome, TaskOutput output);
  void skip_cells(std::size_t index, const WorkerOutcome& outcome);
  void start_cell(std::size_t cell);
  void finish_cell(std::size_t cell, io::StagedFolder files, WorkerOutcome outcome, TaskOutput output);
  io::StagedFolder begin_cell(std::size_t cell);
  void end_cells(std::vector<FinishedCell> kept);
  void end_cell(std::size_t cell, CellResult result, const std::string& summary);
  void mark_missing(std::size_t cell, const std::string& reason);

  Group& group_of(std::size_t cell) { return groups_[plan_.cells[cell].group]; }
  ActiveGroup& active_group_of(std::size_t cell) { return *group_of(cell).active; }
  const study::Scenario& scenario_of(std::size_t cell) const { return *plan_.works[plan_.cells[cell].work].scenario; }

  const RunPlan& plan_;
  int jobs_;
  MakeRecording make_recording_;
  ExecutionEvents events_;
  std::optional<WorkerPool> pool_{std::in_place};
  CellSink* sink_ = nullptr;  ///< while work() runs
  std::vector<Group> groups_;
  std::map<std::size_t, io::StagedFolder> running_;  ///< the unfinished folders of cells
  std::deque<std::size_t> ready_;
  std::size_t next_group_ = 0;
  std::string first_bad_input_;
  bool has_other_failure_ = false;  ///< a cell was started, or something failed for another reason than bad input
  bool interrupted_ = false;
  bool terminated_ = false;
};

}  // namespace scanbench::runs
