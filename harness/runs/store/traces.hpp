// Traces of modules in the file trace.csv of a cell.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/trace/trace.hpp"
#include "core/trace/trace_rows.hpp"
#include "harness/runs/store/run_file.hpp"
#include "harness/runs/store/stored_files.hpp"
#include "harness/study/scenario/trace_choice.hpp"

namespace scanbench::runs {

inline const RunFile kTraceFile("cells/*/*/*/trace.csv");

/// Collects the rows of trace.csv: slot,frame,stage,name,values; `values` are numbers separated by blanks.
class Journal {
 public:
  explicit Journal(study::TraceChoice choice = {.all = true});
  /// A trace of this slot and frame (-1: the whole recording). It records until the next begin(), and only while the
  /// journal exists.
  Trace begin(std::string_view slot, int frame);
  const std::string& csv() const { return text_; }

 private:
  void write(std::string_view name, std::span<const double> values);

  study::TraceChoice choice_;
  std::string text_;
  std::string slot_;
  std::string stage_;
  int frame_ = -1;
};

/// The chosen rows of a cell's trace.csv; none if there is no such file. Throws ConfigError, naming file and line.
TraceRows load_trace(const StoredFiles& cell, const study::TraceChoice& choice);

}  // namespace scanbench::runs
