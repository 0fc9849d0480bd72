// What a trace left behind: read by figures.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace scanbench {

/// One row; frame -1: of the whole recording.
struct TraceRow {
  int frame = -1;
  std::vector<double> values;
};

/// Rows by "slot.name" ("merge.trajectory1"), those of one name in the order in which they were written.
using TraceRows = std::map<std::string, std::vector<TraceRow>, std::less<>>;

}  // namespace scanbench
