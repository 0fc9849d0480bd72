// What listens to the traces of modules: a stopwatch and a journal of rows.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/stage_time.hpp"
#include "core/trace.hpp"
#include "core/trace_rows.hpp"

namespace scanbench::harness {

/// CPU time of the calling thread in seconds: other processes on the machine do not enter it.
double thread_cpu_seconds();

/// Thread CPU time per stage between start() and stop(). Time before the first stage counts for that stage; a module
/// that names none has one time without a stage. Stages are listed in the order of their first appearance.
class Stopwatch {
 public:
  /// A trace whose stages are timed until stop().
  Trace start();
  void stage(Stage begun);
  /// Appends the times since start().
  void stop(std::string_view slot, int frame, std::vector<StageTime>& times);

 private:
  struct Part {
    std::optional<Stage> stage;
    double seconds = 0.0;
  };
  void close_current(double now);

  std::vector<Part> parts_;
  std::size_t current_ = 0;
  double since_ = 0.0;
};

/// Which rows of a trace are kept.
struct TraceChoice {
  bool all = false;
  std::set<std::string, std::less<>> names = {};  ///< "slot.name"

  bool nothing() const { return !all && names.empty(); }
  /// Of `slot`, if no name is given.
  bool wants(std::string_view slot, std::string_view name = {}) const;
  std::string text() const;  ///< "all", "none" or the names: tells two choices apart
};

/// Rows as trace.csv: slot,frame,stage,name,values; `values` are numbers separated by blanks.
class Journal {
 public:
  explicit Journal(TraceChoice choice = {.all = true});
  /// A trace of this slot and frame (-1: the whole recording). It records while the journal lives, until the next one.
  Trace begin(std::string_view slot, int frame);
  const std::string& csv() const { return text_; }

 private:
  void write(std::string_view name, std::span<const double> values);

  TraceChoice choice_;
  std::string text_;
  std::string slot_;
  std::string stage_;
  int frame_ = -1;
};

/// The chosen rows of a cell's trace.csv; none if there is no such file. Throws ConfigError, naming file and line.
TraceRows load_trace(const std::filesystem::path& cell, const TraceChoice& choice);

}  // namespace scanbench::harness
