// Records the stages and rows that a module writes into its trace.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/trace/trace.hpp"
#include "core/trace/trace_rows.hpp"

namespace scanbench::support {

class TraceRecorder {
 public:
  explicit TraceRecorder(std::string slot) : slot_(std::move(slot)) {}
  TraceRecorder(const TraceRecorder&) = delete;

  /// Rows of one kind, in the order in which they were written.
  template <TraceRowType Row>
  std::vector<Row> rows() const {
    return rows_of<Row>(all_rows, slot_);
  }

  std::vector<Stage> stages;
  TraceRows all_rows;
  std::vector<TraceSchema> schemas;  ///< one per row
  Trace trace{{.stage = [this](Stage begun) { stages.push_back(begun); },
               .row =
                   [this](const TraceSchema& schema, std::span<const double> values) {
                     schemas.push_back(schema);
                     all_rows[slot_ + "." + std::string(schema.name)].push_back({-1, {values.begin(), values.end()}});
                   }}};

 private:
  std::string slot_;
};

}  // namespace scanbench::support
