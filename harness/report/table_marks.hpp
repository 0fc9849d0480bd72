// How values become cells of a table: the unit and digits they are shown with, and the mark of the best.
#pragma once

#include <string>
#include <vector>

#include "harness/report/table.hpp"
#include "metrics/metric.hpp"

namespace scanbench::harness {

/// How a metric is shown: `scale` from the metric's unit to `unit`.
struct Display {
  std::string unit;
  double scale = 1.0;
  int decimals = 2;
};

/// Three significant digits of the largest value; lengths below a metre in centimetres, times below a second in
/// milliseconds, radians in degrees.
Display display_for(const std::string& unit, double largest);

/// "name [unit]".
std::string heading(const std::string& metric, const Display& display);

/// Marks the best of the cells whose values are given (NaN: no value); ties are all best. One value alone is not.
void mark_best(const std::vector<TableCell*>& cells, const std::vector<double>& values, metrics::Direction direction);

}  // namespace scanbench::harness
