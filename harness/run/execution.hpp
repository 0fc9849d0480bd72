// Executes planned cells: makes each recording once, and runs each of its cells in a child process.
#pragma once

#include <chrono>
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
#include "harness/files/atomic_file.hpp"
#include "harness/run/run_options.hpp"
#include "harness/run/run_plan.hpp"
#include "harness/run/worker.hpp"
#include "harness/store/cell_status.hpp"

namespace scanbench::harness {

using MakeRecording = std::function<Recording(const Scenario&, std::uint64_t seed, int threads)>;

/// What the owner of an execution hears of.
struct ExecutionEvents {
  /// A cell has ended: its folder is in place and these are its lines of summary.csv, or it is missing.
  std::function<void(std::size_t cell, CellResult result, const std::string& summary)> ended;
  std::function<void(const std::string& what)> began_recording;
  std::function<void()> pause;  ///< between two cells
  /// A folder with these files was put in place; its path is relative to the run (hash_lines() of hash_list.hpp).
  std::function<void(const std::filesystem::path& folder, const std::string& hashes)> wrote = {};
  /// If given, no folder is put in place: before `ended`, the owner copies the files of the cell, and those of its
  /// recording, whose path is empty if it could not be made. If this throws ConfigError, the cell is missing.
  std::function<void(std::size_t cell, const CellResult& result, const std::filesystem::path& files,
                     const std::filesystem::path& recording)>
      copy_files = {};
};

/// Recordings and cells get the folders that recording_path() and cell_path() name. Finished folders are put in place
/// together, as often as a twentieth of the time allows, because each flush of the disk takes milliseconds. With
/// `copy_files`, a few folders are used again and again, because removing one takes milliseconds on some file systems.
class Execution {
 public:
  /// Blocks interrupts (worker.hpp), until release(). `plan` must remain.
  Execution(const RunPlan& plan, int jobs, MakeRecording make_recording, ExecutionEvents events);

  /// Adds a cell to those that work() runs.
  void add(std::size_t cell);

  /// Runs the cells at once, in a folder of this name. After an interrupt, it kills the children that still run after
  /// `grace_seconds` and returns; the finished cells are in place. Throws what the events throw; then no child runs any
  /// more.
  void work(const std::filesystem::path& folder, double grace_seconds = 0.0);

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
    std::optional<StagedFolder> staged;  ///< until the recording is in place, or its last cell was copied
    std::optional<Recording> recording;  ///< while cells need it, if several do
    std::string fault;                   ///< why the recording could not be put in place
    std::string hashes;                  ///< of the recording's files
  };
  struct Group {
    std::vector<std::size_t> cells;
    std::size_t unfinished = 0;
    std::unique_ptr<ActiveGroup> active;  ///< while cells run; a plan may have 10^5 groups
  };
  /// A finished cell whose folder is not yet in place.
  struct Finished {
    std::size_t cell;
    CellResult result;
    std::string summary;
    std::string hashes;  ///< of its files
    StagedFolder staged;
  };

  void prepare_metrics() const;
  void run_all(double grace_seconds);
  void take(WorkerPool::Finished finished);
  bool start_next();
  void start_recording(std::size_t index);
  void finish_recording(std::size_t index, WorkerOutcome outcome);
  std::string hashes_of(const std::filesystem::path& folder) const;
  std::string work_on_cell(std::size_t cell, const std::filesystem::path& folder, const Recording& recording) const;
  void skip_cells(std::size_t index, const WorkerOutcome& outcome);
  void start_cell(std::size_t cell);
  void finish_cell(std::size_t cell, StagedFolder staged, WorkerOutcome outcome);
  std::optional<StagedFolder> stage(std::size_t cell);
  StagedFolder stage_folder(const std::filesystem::path& target);
  void use_again(StagedFolder staged);
  void hand_over();
  void put_in_place();
  void put_in_place_if_due();
  void end_cell(std::size_t cell, CellResult result, const std::string& summary);
  void mark_missing(std::size_t cell, const std::string& reason);

  Group& group_of(std::size_t cell) { return groups_[plan_.cells[cell].group]; }
  ActiveGroup& active_group_of(std::size_t cell) { return *group_of(cell).active; }
  const Scenario& scenario_of(std::size_t cell) const { return *plan_.works[plan_.cells[cell].work].scenario; }

  const RunPlan& plan_;
  int jobs_;
  MakeRecording make_recording_;
  ExecutionEvents events_;
  std::optional<WorkerPool> pool_{std::in_place};
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> empty_folders_;  ///< to be used again
  std::size_t folders_made_ = 0;
  std::vector<Group> groups_;
  std::map<std::size_t, StagedFolder> running_;  ///< the unfinished folders of cells
  std::deque<std::size_t> ready_;
  std::size_t next_group_ = 0;
  std::vector<std::size_t> new_recordings_;  ///< groups whose recording is not yet in place
  std::vector<Finished> finished_;
  std::chrono::steady_clock::time_point due_{};
  std::string first_bad_input_;
  bool has_other_failure_ = false;  ///< a cell was started, or something failed for another reason than bad input
  bool interrupted_ = false;
  bool terminated_ = false;
};

}  // namespace scanbench::harness
