// Status and outcome of a cell.
#pragma once

#include <string>
#include <string_view>

namespace scanbench::runs {

enum class CellStatus {
  ok,
  skipped,        ///< not started, because its input could not be made
  invalid,        ///< a module's result breaks its interface's contract
  failed,         ///< an exception, or an outcome of a module without a result to score
  crashed,        ///< ended by a signal, or without a result
  timeout,        ///< took longer than the limit
  out_of_memory,  ///< needed more memory than the limit
};
std::string_view to_string(CellStatus status);
/// Throws ConfigError for an unknown name.
CellStatus cell_status_from(std::string_view name);

/// How a task ended. On success `message` is what the task returned, else the exception's text, the signal, and the
/// last lines that the child wrote to stdout or stderr.
struct WorkerOutcome {
  CellStatus status = CellStatus::failed;
  std::string message;
  double wall_seconds = 0.0;
  double cpu_seconds = 0.0;
  double peak_memory_bytes = 0.0;
  bool bad_input = false;     ///< failed with a ConfigError, which a user can correct
  bool system_error = false;  ///< failed with a SystemError, like a full disk: the cell is missing
};

}  // namespace scanbench::runs
