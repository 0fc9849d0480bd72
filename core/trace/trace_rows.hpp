// The rows of a trace as numbers from its file, and as the structs that wrote them.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/trace/trace_schema.hpp"

namespace scanbench {

/// One row; frame -1: of the whole recording.
struct TraceRow {
  int frame = -1;
  std::vector<double> values;
};

/// Rows by "slot.name" ("merge.trajectory1"), those of one name in the order in which they were written.
using TraceRows = std::map<std::string, std::vector<TraceRow>, std::less<>>;

/// The key of a kind of row in TraceRows.
template <TraceRowType Row>
std::string key_of(std::string_view slot) {
  return std::string(slot) + "." + std::string(Row::kName);
}

/// All rows of one kind in a slot's trace, in their order. Rows that do not fit the schema are left out.
template <TraceRowType Row>
std::vector<Row> rows_of(const TraceRows& trace, std::string_view slot) {
  std::vector<Row> rows;
  if (const auto found = trace.find(key_of<Row>(slot)); found != trace.end())
    for (const TraceRow& raw : found->second)
      if (const auto row = row_from<Row>(raw.values)) rows.push_back(*row);
  return rows;
}

}  // namespace scanbench
