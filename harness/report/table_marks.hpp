// Formats values as cells of a table, with unit and digits, and marks the best of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/page/table.hpp"
#include "metrics/metric.hpp"

namespace scanbench::harness {

/// How a metric is shown: `scale` from the metric's unit to `unit`.
struct Display {
  std::string unit;
  double scale = 1.0;
  std::optional<int> decimals = {};  ///< as a paper prints; absent: three significant digits of each value
};

/// The unit of a column by its largest magnitude: lengths below a metre in centimetres, times below a second in
/// milliseconds, below a millisecond in microseconds, radians in degrees.
Display display_for(const std::string& unit, double largest);

/// The value in the unit of `display`; "–" if it is undefined. A value that is not zero is never shown as zero.
std::string value_text(double value, const Display& display);

/// "± 0.12" with two significant digits, or with the decimals of `display`; empty if the half width is undefined.
std::string spread_text(double half_width, const Display& display);

/// "name [unit]".
std::string heading(const std::string& metric, const Display& display);

/// Marks the best of the cells that may be marked, and those that read the same. `values` belong to `cells` one by one,
/// NaN: no value; ties are all best. Nothing is marked if the metric has no best value, fewer than two values are
/// finite, or all read the same.
/// `eligible`, one entry per cell, excludes cells from the mark; empty: none is excluded.
void mark_best(const std::vector<TableCell*>& cells, const std::vector<double>& values,
               const metrics::MetricDescription& metric, const std::vector<bool>& eligible = {});

}  // namespace scanbench::harness
