// The two listeners to an algorithm's journal: a stopwatch and a recorder of rows.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "core/trace.hpp"
#include "core/trace_rows.hpp"

namespace scanbench::harness {

/// CPU time of the calling thread in seconds: other processes on the machine do not enter it.
double thread_cpu_seconds();

/// Thread CPU time per stage between start() and stop(). Time before the first named stage goes to that stage; a module
/// that names none has one stage, `whole`. Stages are listed in the order of their first appearance.
class Stopwatch final : public Trace {
 public:
  void start();
  void stage(std::string_view name) override;
  /// The stages since start(), as rows of `frame`, each name with `prefix` in front.
  void stop(std::string_view whole, std::string_view prefix, int frame, std::vector<StageTime>& times);

 private:
  struct Part {
    std::string name;
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
class Journal final : public Trace {
 public:
  explicit Journal(TraceChoice choice = {.all = true});
  /// What follows belongs to this slot and frame (-1: the whole recording).
  void begin(std::string_view slot, int frame);
  bool recording() const override { return choice_.wants(slot_); }
  void stage(std::string_view name) override { stage_ = name; }
  void write(std::string_view name, std::span<const double> values) override;
  const std::string& csv() const { return text_; }

 private:
  TraceChoice choice_;
  std::string text_;
  std::string slot_;
  std::string stage_;
  int frame_ = -1;
};

/// The chosen rows of a cell's trace.csv; none if there is no such file. Throws ConfigError, naming file and line.
TraceRows load_trace(const std::filesystem::path& cell, const TraceChoice& choice);

}  // namespace scanbench::harness
