// Formats values with units and digits, and marks the best.
#include "harness/report/table_marks.hpp"

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

namespace scanbench::harness {
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

void mark_best(const std::vector<TableCell*>& cells, const std::vector<double>& values,
               const metrics::MetricDescription& metric, const std::vector<bool>& eligible) {
  std::set<std::string> finite;  // as they read
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values[i])) finite.insert(cells[i]->text);
  if (finite.size() < 2 || metric.direction == metrics::Direction::neither) return;
  const auto may_win = [&](std::size_t i) { return std::isfinite(values[i]) && (eligible.empty() || eligible[i]); };
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (may_win(i) && (!best || metrics::better(metric, values[i], values[*best]))) best = i;
  if (!best) return;
  for (std::size_t i = 0; i < cells.size(); ++i)
    cells[i]->best =
        may_win(i) && (cells[i]->text == cells[*best]->text || !metrics::better(metric, values[*best], values[i]));
}

}  // namespace scanbench::harness
