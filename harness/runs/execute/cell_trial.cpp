// Runs cells on a few scans in a temporary folder, and measures their time and their files.
#include "harness/runs/execute/cell_trial.hpp"

#include <stdlib.h>

#include <algorithm>
#include <chrono>
#include <system_error>

#include "harness/io/files/system_error.hpp"
#include "harness/runs/execute/cell_work.hpp"
#include "harness/runs/execute/elapsed.hpp"
#include "harness/runs/store/cell_status.hpp"
#include "harness/runs/store/recording_folder.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

double bytes_below(const fs::path& folder) {
  double bytes = 0.0;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (entry->is_regular_file()) bytes += static_cast<double>(entry->file_size());
  return bytes;
}

}  // namespace

CellTrials::CellTrials() {
  std::string name = (fs::temp_directory_path() / "scanbench-forecast-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw io::SystemError("cannot make a folder in " + name);
  path_ = name;
}

CellTrials::~CellTrials() {
  pool_.kill_all();
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path CellTrials::next_folder() {
  const fs::path folder = path_ / std::to_string(folders_++);
  fs::create_directory(folder);
  return folder;
}

TrialCost CellTrials::write(const Recording& recording) {
  const fs::path folder = next_folder();
  const auto start = Clock::now();
  write_recording(folder, recording);
  return {seconds_since(start), bytes_below(folder)};
}

CellTrial CellTrials::run(const PlannedWork& work, const Recording& recording, double seconds) {
  const fs::path folder = next_folder();
  const study::Limits& limits = work.scenario->limits;
  const auto start = Clock::now();
  pool_.start(
      0,
      [&] {
        return TaskOutput(make_cell(folder, path_, *work.scenario, *work.pipeline, work.others, recording).remarks);
      },
      {std::min(seconds, limits.seconds), limits.memory_bytes, 1});
  const auto finished = pool_.wait();
  CellTrial trial{.cost = {seconds_since(start), bytes_below(folder)}};
  if (finished.empty()) return trial;  // interrupted
  const WorkerOutcome& outcome = finished.front().outcome;
  trial.cut_off = outcome.status == CellStatus::timeout && seconds < limits.seconds;
  if (outcome.status != CellStatus::ok && !trial.cut_off)
    trial.fault = std::string(to_string(outcome.status)) + ": " + outcome.message;
  return trial;
}

}  // namespace scanbench::runs
