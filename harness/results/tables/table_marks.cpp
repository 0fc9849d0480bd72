// Formats values with units and digits, and marks the best.
#include "harness/results/tables/table_marks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <set>
#include <string>

#include <fmt/format.h>

#include "core/geometry/angles.hpp"
#include "core/special_values.hpp"

namespace scanbench::results {
namespace {

// Decimals that show `digits` significant digits of the value.
int decimals_for(double value, int digits) {
  return digits - 1 - static_cast<int>(std::floor(std::log10(std::fabs(value))));
}

std::string significant(double value, int digits) {
  if (value == 0.0) return "0";
  if (!std::isfinite(value)) return fmt::format("{}", value);
  const int decimals = decimals_for(value, digits);
  if (decimals > 6 + digits) return fmt::format("{:.{}e}", value, digits - 1);
  return fmt::format("{:.{}f}", value, std::max(decimals, 0));
}

std::string shown(double value, const Display& display, int digits) {
  const double scaled = value * display.scale;
  if (!display.decimals) return significant(scaled, digits);
  const bool vanishes = scaled != 0.0 && std::fabs(scaled) < 0.5 * std::pow(10.0, -*display.decimals);
  return vanishes ? significant(scaled, digits) : fmt::format("{:.{}f}", scaled, *display.decimals);
}

}  // namespace

Display display_for(const std::string& unit, double largest) {
  if (unit == "m" && largest < 1.0) return {"cm", 100.0};
  if (unit == "s" && largest < 1e-3) return {"µs", 1e6};
  if (unit == "s" && largest < 1.0) return {"ms", 1e3};
  if (unit == "ms" && largest < 1.0) return {"µs", 1e3};
  if (unit == "us") return {"µs", 1.0};
  if (unit == "rad") return {"deg", 180.0 / kPi};
  return {unit, 1.0};
}

std::string value_text(double value, const Display& display) {
  return std::isnan(value) ? "–" : shown(value, display, 3);
}

std::string spread_text(double half_width, const Display& display) {
  return std::isnan(half_width) ? "" : "± " + shown(half_width, display, 2);
}

std::string heading(const std::string& metric, const Display& display) {
  return display.unit.empty() ? metric : metric + " [" + display.unit + "]";
}

const std::string& words_of(const metrics::MetricDescription& metric) {
  return metric.label.empty() ? metric.metric : metric.label;
}

std::string page_heading(const metrics::MetricDescription& metric, const Display& display) {
  const std::string text = heading(words_of(metric), display);
  switch (metric.direction) {
    case metrics::Direction::higher_is_better:
      return text + " ↑";
    case metrics::Direction::lower_is_better:
      return text + " ↓";
    case metrics::Direction::target:
      return fmt::format("{} ≈ {:.4g}", text, metric.target * display.scale);
    case metrics::Direction::neither:
      break;
  }
  return text;
}

TableColumn metric_column(const metrics::MetricDescription& metric, const Display& display) {
  return {"", heading(metric.metric, display), false, metric.metric, page_heading(metric, display)};
}

TableColumn column_below(const metrics::MetricDescription& metric, const Display& display, const std::string& head,
                         bool published) {
  return {heading(metric.metric, display), head, published, metric.metric, page_heading(metric, display)};
}

std::string seeds_text(const std::vector<double>& seeds, ValueRange range, const Display& display) {
  constexpr double kLopsided = 0.1;  // of the half width
  const MeanInterval interval = seed_interval(seeds, range);
  const std::string text = value_text(interval.mean, display);
  if (interval.count < 2) return text;
  const double half = interval.half_width();
  const bool even = std::fabs(0.5 * (interval.low + interval.high) - interval.mean) <= kLopsided * half;
  if (interval.count >= kFewestForInterval && even) return text + " " + spread_text(half, display);
  return fmt::format("{} ({} to {})", text, value_text(interval.low, display), value_text(interval.high, display));
}

void mark_best(const std::vector<TableCell*>& cells, const std::vector<std::vector<double>>& seeds,
               const metrics::MetricDescription& metric, const std::vector<bool>& eligible) {
  if (metric.direction == metrics::Direction::neither) return;
  std::set<std::string> finite;  // as they read
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool has_value = std::isfinite(seed_interval(seeds[i], ValueRange::any).mean);
    if (has_value) finite.insert(cells[i]->text);
    cells[i]->not_eligible = has_value && !eligible.empty() && !eligible[i];
  }
  const std::vector<int> best = shared_best(seeds, metric, eligible);
  if (finite.size() < 2 || best.empty()) return;
  for (const int i : best) cells[as_index(i)]->best = true;
  for (TableCell* cell : cells)
    if (cell->text == cells[as_index(best.front())]->text && !cell->not_eligible) cell->best = true;
}

}  // namespace scanbench::results
