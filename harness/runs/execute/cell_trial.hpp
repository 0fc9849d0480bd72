// Trial runs of a cell on a few scans, for forecasts.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "core/recording.hpp"
#include "harness/runs/execute/run_plan.hpp"
#include "harness/runs/execute/worker.hpp"

namespace scanbench::runs {

struct TrialCost {
  double seconds = 0.0;
  double bytes = 0.0;  ///< of the files
};

struct CellTrial {
  TrialCost cost;
  bool cut_off = false;    ///< it was killed after the seconds that it was given
  std::string fault = {};  ///< "crashed: ..." if it was not ok for another reason
};

/// Its folder, a temporary one, is removed in the end. May exist while no WorkerPool does.
class CellTrials {
 public:
  /// Throws SystemError if there is no place for temporary files.
  CellTrials();
  ~CellTrials();
  CellTrials(const CellTrials&) = delete;
  CellTrials& operator=(const CellTrials&) = delete;

  /// What writing the recording takes, without making it.
  TrialCost write(const Recording& recording);
  /// Runs the cell in a child process, and kills it after `seconds`. Must be called while the process has one thread.
  CellTrial run(const PlannedWork& work, const Recording& recording, double seconds);
  /// True after a signal to end: then the last trial is not one.
  bool interrupted() const { return pool_.interrupted(); }

 private:
  std::filesystem::path next_folder();
  std::filesystem::path path_;
  std::size_t folders_ = 0;
  WorkerPool pool_;
};

}  // namespace scanbench::runs
