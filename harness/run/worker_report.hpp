// What a child reports of its tasks, as bytes of a pipe.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "harness/store/cell_status.hpp"

namespace scanbench::harness {

/// Runs the task. The outcome has the status, the message (cut to a few kB if it is an exception's) and the two flags.
WorkerOutcome perform(const std::function<std::string()>& task);

/// The bytes of a report. The wall time is not among them, because the parent measures it.
std::string report_bytes(const WorkerOutcome& outcome);

/// Takes the first report from `bytes`. nullopt if it is incomplete or no report: then `bytes` stays as it is.
std::optional<WorkerOutcome> take_report(std::string& bytes);

}  // namespace scanbench::harness
