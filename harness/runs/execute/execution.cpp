// Schedules cells: those of one recording form a group, and at most `jobs` children run at once.
#include "harness/runs/execute/execution.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <map>
#include <utility>

#include <malloc.h>

#include "core/error.hpp"
#include "core/registry.hpp"
#include "harness/io/files/hash.hpp"
#include "harness/io/files/hash_list.hpp"
#include "harness/io/files/system_error.hpp"
#include "harness/runs/execute/cell_work.hpp"
#include "harness/runs/store/cell_files.hpp"
#include "harness/runs/store/recording_folder.hpp"
#include "harness/runs/store/summary.hpp"
#include "metrics/metric.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

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

void Execution::work(CellSink& sink, double grace_seconds) {
  sink_ = &sink;
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
  end_cells(sink_->flush());
  interrupted_ = pool_->interrupted();
  terminated_ = pool_->terminated();
  for (auto& group : groups_) group.active.reset();
}

/// A library that a metric needs is loaded here once, and not in each of several cells, most of which take less time.
void Execution::prepare_metrics() const {
  std::map<std::string, std::size_t> cells;  // by family
  std::map<std::string, const study::ModuleChoice*> families;
  for (const Group& group : groups_)
    for (const std::size_t cell : group.cells)
      for (const study::ModuleChoice& choice : scenario_of(cell).metrics) {
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
    end_cells(sink_->flush_if_due());  // while the children run
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
    finish_cell(finished.id, std::move(running_.extract(finished.id).mapped()), std::move(finished.outcome),
                std::move(finished.output));
  else
    finish_recording(finished.id - plan_.cells.size(), std::move(finished.outcome), std::move(finished.output));
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
  events_.began_recording("recording " + planned.scenario->name + "/" + std::to_string(planned.seed));
  try {
    group.files.emplace(sink_->begin(index, recording_path("", planned.scenario->name, planned.seed)));
    std::optional<io::StagedFolder> cell_folder;
    if (cells.size() == 1) cell_folder.emplace(begin_cell(cells.front()));
    start_children(index, std::move(cell_folder));
  } catch (const ConfigError& e) {
    group.files.reset();
    skip_cells(index, {.message = e.what(), .system_error = true});
  }
}

/// Starts the tasks of a recording and, if a folder is given, of its only cell.
void Execution::start_children(std::size_t index, std::optional<io::StagedFolder> cell_folder) {
  const int threads = std::max(1, jobs_ - static_cast<int>(pool_->running()));
  const study::Limits& limits = plan_.groups[index].scenario->limits;
  std::optional<Recording> made;  // in the child
  std::vector<WorkerTask> tasks{{plan_.cells.size() + index,
                                 [&] { return work_on_recording(index, threads, made); },
                                 {limits.seconds, limits.memory_bytes, threads}}};
  const std::size_t cell = groups_[index].cells.front();
  if (cell_folder)
    tasks.push_back({cell,
                     [&] { return work_on_cell(cell, cell_folder->path(), *made); },
                     {limits.seconds, limits.memory_bytes, 1}});
  pool_->start(tasks);
  if (cell_folder) running_.emplace(cell, std::move(*cell_folder));
}

/// What a recording's child does.
TaskOutput Execution::work_on_recording(std::size_t index, int threads, std::optional<Recording>& made) const {
  const PlannedGroup& planned = plan_.groups[index];
  const fs::path& folder = groups_[index].active->files->path();
  made = make_recording_(*planned.scenario, planned.seed, threads);
  TaskOutput output;
  output.content_hash = write_recording(folder, *made);
  output.file_hashes = sink_->hashes_of(folder);
  return output;
}

/// What a cell's child does.
TaskOutput Execution::work_on_cell(std::size_t cell, const fs::path& folder, const Recording& recording) const {
  const PlannedCell& planned = plan_.cells[cell];
  const PlannedWork& work = plan_.works[planned.work];
  const CellOutput made =
      make_cell(folder, sink_->root(), *work.scenario, *work.pipeline, plan_.trace(planned), recording);
  TaskOutput output(made.remarks);
  output.summary = summary_lines(plan_.key(planned), made.rows);
  output.file_hashes = sink_->hashes_of(folder);
  return output;
}

void Execution::finish_recording(std::size_t index, WorkerOutcome outcome, TaskOutput output) {
  ActiveGroup& group = *groups_[index].active;
  const std::vector<std::size_t>& cells = groups_[index].cells;
  const bool with_cell = cells.size() == 1;
  if (outcome.status == CellStatus::ok) {
    try {
      if (!with_cell) group.recording = load_recording(group.files->path());
      sink_->put(FinishedRecording{index, std::move(output.content_hash), std::move(output.file_hashes),
                                   std::move(*group.files)});
      group.files.reset();
      if (with_cell)
        has_other_failure_ = true;
      else
        ready_.insert(ready_.end(), cells.begin(), cells.end());
      return;
    } catch (const io::SystemError& e) {
      outcome = {.message = e.what(), .system_error = true};
    } catch (const std::exception& e) {
      outcome = {.status = CellStatus::failed, .message = e.what()};
    }
  }
  group.files.reset();
  skip_cells(index, outcome);
}

void Execution::skip_cells(std::size_t index, const WorkerOutcome& outcome) {
  if (outcome.bad_input && first_bad_input_.empty()) first_bad_input_ = outcome.message;
  has_other_failure_ = has_other_failure_ || !outcome.bad_input;
  const std::string message =
      "there is no recording: " + std::string(to_string(outcome.status)) + ": " + outcome.message;
  for (const std::size_t cell : groups_[index].cells) {
    auto begun = running_.extract(cell);
    if (outcome.system_error) {
      mark_missing(cell, outcome.message);
      continue;
    }
    try {
      finish_cell(cell, begun ? std::move(begun.mapped()) : begin_cell(cell),
                  {.status = CellStatus::skipped, .message = message}, {});
    } catch (const ConfigError& e) {
      mark_missing(cell, e.what());
    }
  }
}

void Execution::start_cell(std::size_t cell) {
  has_other_failure_ = true;
  const study::Limits& limits = scenario_of(cell).limits;
  try {
    io::StagedFolder files = begin_cell(cell);
    const auto task = [&] { return work_on_cell(cell, files.path(), *active_group_of(cell).recording); };
    pool_->start(cell, task, {limits.seconds, limits.memory_bytes, 1});
    running_.emplace(cell, std::move(files));
  } catch (const ConfigError& e) {
    mark_missing(cell, e.what());
  }
}

void Execution::finish_cell(std::size_t cell, io::StagedFolder files, WorkerOutcome outcome, TaskOutput output) {
  if (outcome.system_error) {
    mark_missing(cell, outcome.message);
    return;
  }
  const PlannedCell& planned = plan_.cells[cell];
  CellResult result;
  result.key = plan_.key(planned);
  result.done = true;
  result.record = {std::move(outcome), plan_.address(planned)};
  try {
    if (result.record.outcome.status != CellStatus::ok) files.clear();
    const std::string status = status_json(result.record);
    io::write_staged_file(files.path() / kStatusFile, status);
    output.file_hashes += io::hash_line(kStatusFile.name(), io::sha256_hex(status));
  } catch (const ConfigError& e) {
    mark_missing(cell, e.what());
    return;
  }
  sink_->put(FinishedCell{cell, planned.group, std::move(result), std::move(output.summary),
                          std::move(output.file_hashes), std::move(files)});
}

io::StagedFolder Execution::begin_cell(std::size_t cell) {
  const PlannedCell& planned = plan_.cells[cell];
  return sink_->begin(planned.group, cell_path("", plan_.key(planned)));
}

void Execution::end_cells(std::vector<FinishedCell> kept) {
  for (auto& cell : kept) {
    if (cell.fault.empty())
      end_cell(cell.cell, std::move(cell.result), cell.summary);
    else
      mark_missing(cell.cell, cell.fault);
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
  if (--group.unfinished == 0) group.active.reset();
  events_.ended(cell, std::move(result), summary);
}

}  // namespace scanbench::runs
