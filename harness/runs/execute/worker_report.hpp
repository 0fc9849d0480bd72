// What a child reports of its tasks, as bytes of a pipe.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "harness/runs/store/cell_status.hpp"

namespace scanbench::runs {

inline constexpr std::size_t kLargestReport = 8 << 20;  ///< bytes

/// What a task that ends well tells its parent, beside the files that it writes.
struct TaskOutput {
  TaskOutput(std::string text = "") : message(std::move(text)) {}  // NOLINT(*-explicit-*): many tasks have a text only

  std::string message;       ///< becomes that of the outcome
  std::string content_hash;  ///< of the recording that was made
  std::string summary;       ///< lines of summary.csv
  std::string file_hashes;   ///< of the files that were written
};

struct WorkerReport {
  WorkerOutcome outcome;
  TaskOutput output{};  ///< without its message; empty unless the outcome is ok
};

/// Runs the task. The outcome has the status, the message (cut to a few kB if it is an exception's) and the two flags.
WorkerReport perform(const std::function<TaskOutput()>& task);

/// The bytes of a report. The wall time is not among them, because the parent measures it.
std::string report_bytes(const WorkerReport& report);

/// Takes the first report from `bytes`. nullopt if it is incomplete, no report or too large: then `bytes` stays as it
/// is.
std::optional<WorkerReport> take_report(std::string& bytes);

}  // namespace scanbench::runs
