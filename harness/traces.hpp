// The two listeners to an algorithm's journal: a stopwatch and a recorder of rows.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "core/trace.hpp"

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

/// Rows as trace.csv: slot,frame,stage,name,values; `values` are numbers separated by blanks.
class Journal final : public Trace {
 public:
  Journal();
  /// What follows belongs to this slot and frame (-1: the whole recording).
  void begin(std::string_view slot, int frame);
  bool recording() const override { return true; }
  void stage(std::string_view name) override { stage_ = name; }
  void write(std::string_view name, std::span<const double> values) override;
  const std::string& csv() const { return text_; }

 private:
  std::string text_;
  std::string slot_;
  std::string stage_;
  int frame_ = -1;
};

}  // namespace scanbench::harness
