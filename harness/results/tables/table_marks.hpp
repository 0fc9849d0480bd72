// Formats values as cells of a table, with unit and digits, and marks the best of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/results/analysis/shared_best.hpp"
#include "harness/results/document/table.hpp"
#include "metrics/metric.hpp"

namespace scanbench::results {

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

/// The label of a metric, or its id if it has none.
const std::string& words_of(const metrics::MetricDescription& metric);

/// "name [unit]".
std::string heading(const std::string& metric, const Display& display);

/// The head of a metric's column on a page: its label, the unit and which values are better: "offset error [cm] ↓",
/// "F1 ↑", "NEES ≈ 2".
std::string page_heading(const metrics::MetricDescription& metric, const Display& display);

/// A column of a metric, with its head for a terminal and for pages.
TableColumn metric_column(const metrics::MetricDescription& metric, const Display& display);

/// A column below the head of a metric: one of several pipelines, or of ours and a paper's.
TableColumn column_below(const metrics::MetricDescription& metric, const Display& display, const std::string& head,
                         bool published = false);

/// What the arrows in heads mean, in a sentence.
inline constexpr const char* kArrowKey =
    "↑ more is better, ↓ less is better, ≈ best near that value. The pointer on a head shows the name of its metric in "
    "files.";

/// A line that a pipeline misses in a larger share of the scans is not found: its other values are not compared.
constexpr double kMostMissed = 0.5;

/// The mean over seeds with its interval, or with the range of fewer than kFewestForInterval values: "0.80 ± 0.03" if
/// the ends are about equally far from the mean, else "0.97 (0.88 to 0.99)". "–" without a value.
std::string seeds_text(const std::vector<double>& seeds, ValueRange range, const Display& display);

/// Marks the cells that shared_best() finds, and those that read like the best. Nothing is marked if fewer than two
/// cells have a value, or all read the same. Cells that are not `eligible` become grey.
void mark_best(const std::vector<TableCell*>& cells, const std::vector<std::vector<double>>& seeds,
               const metrics::MetricDescription& metric, const std::vector<bool>& eligible = {});

}  // namespace scanbench::results
