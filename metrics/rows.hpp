// Tools of the metric families: averages that are undefined without observations, and the rows of a table.
#pragma once

#include <cmath>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/special_values.hpp"
#include "metrics/metric.hpp"

namespace scanbench::metrics {

inline constexpr double kUndefined = kNaN;
inline constexpr std::string_view kAll = "all";

/// A count as the value of a row.
inline double number(std::integral auto count) {
  return static_cast<double>(count);
}

/// numerator / denominator; NaN when the denominator is 0.
inline double ratio(double numerator, double denominator) {
  return denominator != 0 ? numerator / denominator : kUndefined;
}

/// Arithmetic mean of weighted observations; NaN without observations.
class Mean {
 public:
  void add(double value, double weight = 1.0) {
    sum_ += weight * value;
    weight_ += weight;
    ++count_;
  }
  double value() const { return ratio(sum_, weight_); }
  double root() const { return std::sqrt(value()); }
  std::int64_t count() const { return count_; }

 private:
  double sum_ = 0.0;
  double weight_ = 0.0;
  std::int64_t count_ = 0;
};

/// Rows in the order in which they are added, with the units of the family's description.
class Rows {
 public:
  explicit Rows(std::vector<MetricDescription> descriptions) : descriptions_(std::move(descriptions)) {}

  /// A value that is not finite becomes NaN with count 0. The metric must be one that the family describes.
  MetricRow& add(std::string_view metric, std::string_view subject, double value, std::int64_t count);
  MetricRow& add(std::string_view metric, std::string_view subject, const Mean& mean) {
    return add(metric, subject, mean.value(), mean.count());
  }
  std::vector<MetricRow> take() { return std::move(rows_); }

 private:
  std::vector<MetricDescription> descriptions_;
  std::vector<MetricRow> rows_;
};

/// One subject per wall: its label, with the index added where walls share a label or have none ("door#7").
std::vector<std::string> wall_subjects(std::span<const Wall> walls);

}  // namespace scanbench::metrics
