// Schedules cells: those of one recording form a group, and at most `jobs` children run at once.
#include "harness/run/execution.hpp"

#include <algorithm>
#include <exception>
#include <initializer_list>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include <malloc.h>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "core/registry.hpp"
#include "harness/files/hash.hpp"
#include "harness/files/hash_list.hpp"
#include "harness/files/system_error.hpp"
#include "harness/run/cell_work.hpp"
#include "harness/store/cell_files.hpp"
#include "harness/store/recording_folder.hpp"
#include "harness/store/summary.hpp"
#include "metrics/metric.hpp"

namespace scanbench::harness {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

/// Of the time, the part that is spent on flushing the disk: one in this many.
constexpr int kFlushShare = 20;

/// Several texts as one: each after its length.
std::string packed(std::initializer_list<std::string_view> texts) {
  std::string all;
  for (const std::string_view text : texts) all.append(std::to_string(text.size())).append(" ").append(text);
  return all;
}

/// Takes the first text.
std::string unpack(std::string& all) {
  const std::size_t blank = all.find(' ');
  const auto size = static_cast<std::size_t>(parse_number(std::string_view(all).substr(0, blank)).value_or(0.0));
  std::string text = all.substr(blank + 1, size);
  all.erase(0, blank + 1 + size);
  return text;
}

}  // namespace

Execution::Execution(const RunPlan& plan, int jobs, MakeRecording make_recording, ExecutionEvents events)
    : plan_(plan),
      jobs_(jobs),
      make_recording_(std::move(make_recording)),
      events_(std::move(events)),
      groups_(plan.groups.size()) {}

void Execution::add(std::size_t cell) {
  group_of(cell).cells.push_back(cell);
  ++group_of(cell).unfinished;
}

void Execution::work(const fs::path& folder, double grace_seconds) {
  folder_ = folder;
  prepare_metrics();
  ::malloc_trim(0);  // each fork copies the page tables of what this process holds, freed or not
  try {
    run_all(grace_seconds);
  } catch (...) {
    pool_->kill_all();  // before the folders that the children write are removed
    throw;
  }
  pool_->kill_all();
  running_.clear();
  put_in_place();
  interrupted_ = pool_->interrupted();
  terminated_ = pool_->terminated();
  for (auto& group : groups_) group.active.reset();
  std::error_code ignored;
  for (const auto& empty : std::exchange(empty_folders_, {})) fs::remove(empty, ignored);
}

/// A library that a metric needs is loaded here once, and not in each of several cells, most of which take less time.
void Execution::prepare_metrics() const {
  std::map<std::string, std::size_t> cells;  // by family
  std::map<std::string, const ModuleChoice*> families;
  for (const Group& group : groups_)
    for (const std::size_t cell : group.cells)
      for (const ModuleChoice& choice : scenario_of(cell).metrics) {
        ++cells[choice.module];
        families[choice.module] = &choice;
      }
  for (const auto& [name, choice] : families) {
    if (cells[name] < 2) continue;
    try {
      Registry<metrics::MetricFamily>::make(name, choice->params)->prepare();
    } catch (const ConfigError&) {
      // The cells say what is missing.
    }
  }
}

void Execution::run_all(double grace_seconds) {
  while (!pool_->interrupted()) {
    while (pool_->running() < static_cast<std::size_t>(jobs_) && start_next()) {
    }
    put_in_place_if_due();  // while the children run
    if (pool_->running() == 0) break;
    for (auto& finished : pool_->wait()) take(std::move(finished));
    events_.pause();
  }
  const auto end = Clock::now() + std::chrono::duration<double>(grace_seconds);
  while (pool_->interrupted() && pool_->running() > 0 && Clock::now() < end) {
    const double left = std::chrono::duration<double>(end - Clock::now()).count();
    for (auto& finished : pool_->wait_despite_interrupts(left)) take(std::move(finished));
  }
}

void Execution::take(WorkerPool::Finished finished) {
  if (finished.id < plan_.cells.size())
    finish_cell(finished.id, std::move(running_.extract(finished.id).mapped()), std::move(finished.outcome));
  else
    finish_recording(finished.id - plan_.cells.size(), std::move(finished.outcome));
}

/// Starts a cell whose recording exists, else the next recording. False if there is nothing to start now.
bool Execution::start_next() {
  if (!ready_.empty()) {
    const std::size_t cell = ready_.front();
    ready_.pop_front();
    start_cell(cell);
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

/// Starts the child that makes a recording. A cell that is the only one of its recording runs in the same child.
void Execution::start_recording(std::size_t index) {
  groups_[index].active = std::make_unique<ActiveGroup>();
  ActiveGroup& group = *groups_[index].active;
  const PlannedGroup& planned = plan_.groups[index];
  const std::vector<std::size_t>& cells = groups_[index].cells;
  const bool with_cell = cells.size() == 1;
  std::optional<StagedFolder> cell_folder;
  try {
    group.staged.emplace(stage_folder(recording_path(folder_, planned.scenario->name, planned.seed)));
    if (with_cell) cell_folder.emplace(stage_folder(cell_path(folder_, plan_.key(plan_.cells[cells.front()]))));
  } catch (const ConfigError& e) {
    group.staged.reset();
    skip_cells(index, {.message = e.what(), .system_error = true});
    return;
  }
  const int threads = std::max(1, jobs_ - static_cast<int>(pool_->running()));
  events_.began_recording("recording " + planned.scenario->name + "/" + std::to_string(planned.seed));
  std::optional<Recording> made;  // in the child
  const auto make = [&] {
    made = make_recording_(*planned.scenario, planned.seed, threads);
    const std::string hash = write_recording(group.staged->path(), *made);
    return packed({hash, hashes_of(group.staged->path())});
  };
  const Limits& limits = planned.scenario->limits;
  std::vector<WorkerTask> tasks{{plan_.cells.size() + index, make, {limits.seconds, limits.memory_bytes, threads}}};
  if (with_cell)
    tasks.push_back({cells.front(),
                     [&] { return work_on_cell(cells.front(), cell_folder->path(), *made); },
                     {limits.seconds, limits.memory_bytes, 1}});
  try {
    pool_->start(tasks);
    if (with_cell) running_.emplace(cells.front(), std::move(*cell_folder));
  } catch (const SystemError& e) {
    group.staged.reset();
    skip_cells(index, {.message = e.what(), .system_error = true});
  }
}

void Execution::finish_recording(std::size_t index, WorkerOutcome outcome) {
  ActiveGroup& group = *groups_[index].active;
  const std::vector<std::size_t>& cells = groups_[index].cells;
  const bool with_cell = cells.size() == 1;
  if (outcome.status == CellStatus::ok) {
    const std::string hash = unpack(outcome.message);
    group.hashes = unpack(outcome.message);
    try {
      if (!with_cell) group.recording = load_recording(group.staged->path());
      // The new recording replaces the old one only if it differs.
      try {
        if (fs::exists(group.staged->target()) && recording_hash(load_recording(group.staged->target())) == hash)
          group.staged.reset();
      } catch (const ConfigError&) {
        // The old recording is damaged.
      }
      if (group.staged && !events_.copy_files) new_recordings_.push_back(index);
      if (with_cell)
        has_other_failure_ = true;
      else
        ready_.insert(ready_.end(), cells.begin(), cells.end());
      return;
    } catch (const SystemError& e) {
      outcome = {.message = e.what(), .system_error = true};
    } catch (const std::exception& e) {
      outcome = {.status = CellStatus::failed, .message = e.what()};
    }
  }
  group.staged.reset();
  skip_cells(index, outcome);
}

void Execution::skip_cells(std::size_t index, const WorkerOutcome& outcome) {
  if (outcome.bad_input && first_bad_input_.empty()) first_bad_input_ = outcome.message;
  has_other_failure_ = has_other_failure_ || !outcome.bad_input;
  const std::string message =
      "there is no recording: " + std::string(to_string(outcome.status)) + ": " + outcome.message;
  for (const std::size_t cell : groups_[index].cells) {
    auto begun = running_.extract(cell);
    if (outcome.system_error)
      mark_missing(cell, outcome.message);
    else if (auto staged = begun ? std::optional(std::move(begun.mapped())) : stage(cell))
      finish_cell(cell, std::move(*staged), {.status = CellStatus::skipped, .message = message});
  }
}

/// Nobody needs them if the files are copied.
std::string Execution::hashes_of(const fs::path& folder) const {
  return events_.wrote && !events_.copy_files ? hash_lines(folder) : "";
}

/// What a cell's child does. Returns its remarks, the lines of the summary, and the hashes of its files.
std::string Execution::work_on_cell(std::size_t cell, const fs::path& folder, const Recording& recording) const {
  const PlannedCell& planned = plan_.cells[cell];
  const PlannedWork& work = plan_.works[planned.work];
  const CellOutput output = make_cell(folder, *work.scenario, *work.pipeline, plan_.trace(planned), recording);
  return packed({output.remarks, summary_lines(plan_.key(planned), output.rows), hashes_of(folder)});
}

void Execution::start_cell(std::size_t cell) {
  has_other_failure_ = true;
  if (!active_group_of(cell).fault.empty()) {
    mark_missing(cell, active_group_of(cell).fault);
    return;
  }
  std::optional<StagedFolder> staged = stage(cell);
  if (!staged) return;
  const Limits& limits = scenario_of(cell).limits;
  const auto task = [&] { return work_on_cell(cell, staged->path(), *active_group_of(cell).recording); };
  try {
    pool_->start(cell, task, {limits.seconds, limits.memory_bytes, 1});
    running_.emplace(cell, std::move(*staged));
  } catch (const SystemError& e) {
    mark_missing(cell, e.what());
  }
}

void Execution::finish_cell(std::size_t cell, StagedFolder staged, WorkerOutcome outcome) {
  if (outcome.system_error) {
    mark_missing(cell, outcome.message);
    return;
  }
  const PlannedCell& planned = plan_.cells[cell];
  CellResult result;
  result.key = plan_.key(planned);
  result.done = true;
  try {
    std::string summary;
    std::string hashes;
    if (outcome.status == CellStatus::ok) {
      std::string report = std::exchange(outcome.message, "");
      outcome.message = unpack(report);
      summary = unpack(report);
      hashes = unpack(report);
    } else {
      staged.clear();
    }
    result.record.outcome = std::move(outcome);
    result.record.address = plan_.address(planned);
    const std::string status = status_json(result.record);
    write_staged_file(staged.path() / kStatusFile, status);
    hashes += hash_line(kStatusFile.name(), sha256_hex(status));
    finished_.push_back({cell, std::move(result), std::move(summary), std::move(hashes), std::move(staged)});
  } catch (const ConfigError& e) {
    mark_missing(cell, e.what());
  }
}

/// Makes the unfinished folder of a cell. If that fails, marks the cell as missing.
std::optional<StagedFolder> Execution::stage(std::size_t cell) {
  try {
    return stage_folder(cell_path(folder_, plan_.key(plan_.cells[cell])));
  } catch (const ConfigError& e) {
    mark_missing(cell, e.what());
    return std::nullopt;
  }
}

StagedFolder Execution::stage_folder(const fs::path& target) {
  if (!events_.copy_files) return StagedFolder(target);
  if (!empty_folders_.empty()) {
    fs::path folder = std::move(empty_folders_.back());
    empty_folders_.pop_back();
    return StagedFolder::in_empty_folder(target, std::move(folder));
  }
  const std::string name = "files" + std::to_string(folders_made_++);
  return {folder_ / name, folder_ / ("." + name)};
}

/// Removes the files of a folder and keeps it. A folder that cannot be emptied is removed, as far as possible.
void Execution::use_again(StagedFolder staged) {
  std::error_code error;
  for (fs::directory_iterator entry(staged.path(), error), end; !error && entry != end; entry.increment(error))
    if (!fs::remove_all(entry->path(), error) || error) return;
  if (!error) empty_folders_.push_back(staged.release());
}

/// Lets the owner copy the files of finished cells.
void Execution::hand_over() {
  for (Finished& cell : std::exchange(finished_, {})) {
    Group& group = group_of(cell.cell);
    std::string fault;
    try {
      const std::optional<StagedFolder>& recording = group.active->staged;
      events_.copy_files(cell.cell, cell.result, cell.staged.path(), recording ? recording->path() : fs::path());
    } catch (const ConfigError& e) {
      fault = e.what();
    }
    use_again(std::move(cell.staged));
    if (fault.empty())
      end_cell(cell.cell, std::move(cell.result), cell.summary);
    else
      mark_missing(cell.cell, fault);
    if (group.unfinished > 0) continue;
    if (group.active->staged) use_again(std::move(*group.active->staged));
    group.active.reset();
  }
}

void Execution::put_in_place_if_due() {
  const auto begun = Clock::now();
  if (finished_.empty() || begun < due_) return;
  put_in_place();
  const auto ended = Clock::now();
  if (!events_.copy_files) due_ = ended + kFlushShare * (ended - begun);
}

/// Puts finished recordings in place, then finished cells. Cells whose folder cannot be put in place are missing.
void Execution::put_in_place() {
  if (events_.copy_files) {
    hand_over();
    return;
  }
  std::string fault;
  std::set<fs::path> parents;
  const auto place = [&](StagedFolder& staged, const std::string& hashes) -> std::string {
    if (!fault.empty()) return fault;
    try {
      staged.place();
      if (events_.wrote) events_.wrote(staged.target().lexically_relative(folder_), hashes);
      parents.insert(staged.target().parent_path());
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "";
  };
  try {
    if (!finished_.empty())
      finished_.front().staged.flush();
    else if (!new_recordings_.empty())
      groups_[new_recordings_.front()].active->staged->flush();
  } catch (const ConfigError& e) {
    fault = e.what();
  }
  for (const std::size_t index : std::exchange(new_recordings_, {})) {
    ActiveGroup& group = *groups_[index].active;
    group.fault = place(*group.staged, std::exchange(group.hashes, ""));
    group.staged.reset();
  }
  std::vector<Finished> ended = std::exchange(finished_, {});
  std::vector<std::string> faults;
  faults.reserve(ended.size());
  for (auto& cell : ended)
    faults.push_back(active_group_of(cell.cell).fault.empty() ? place(cell.staged, cell.hashes)
                                                              : active_group_of(cell.cell).fault);
  try {
    for (const auto& parent : parents) flush_folder(parent);
  } catch (const ConfigError& e) {
    faults.assign(faults.size(), e.what());
  }
  for (std::size_t i = 0; i < ended.size(); ++i) {
    if (faults[i].empty())
      end_cell(ended[i].cell, std::move(ended[i].result), ended[i].summary);
    else
      mark_missing(ended[i].cell, faults[i]);
    if (group_of(ended[i].cell).unfinished == 0) group_of(ended[i].cell).active.reset();
  }
}

/// Marks a cell as missing after a failure of the system, like a full disk. The run is then incomplete, but other cells
/// may succeed.
void Execution::mark_missing(std::size_t cell, const std::string& reason) {
  const PlannedCell& planned = plan_.cells[cell];
  CellResult result;
  result.key = plan_.key(planned);
  result.record.address = plan_.address(planned);
  result.record.outcome.message = reason;
  end_cell(cell, std::move(result), "");
}

void Execution::end_cell(std::size_t cell, CellResult result, const std::string& summary) {
  Group& group = group_of(cell);
  if (--group.unfinished == 0 && group.active) group.active->recording.reset();
  events_.ended(cell, std::move(result), summary);
}

}  // namespace scanbench::harness
