// The two listeners to an algorithm's journal: a stopwatch and a recorder of rows.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/trace.hpp"
#include "core/trace_rows.hpp"
#include "harness/scenario/trace_choice.hpp"

namespace scanbench::harness {

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
