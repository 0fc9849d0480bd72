// Units, digits and marks.
#include "harness/report/table_marks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angles.hpp"

namespace scanbench::harness {

Display display_for(const std::string& unit, double largest) {
  Display display{unit, 1.0, 2};
  if (unit == "m" && largest < 1.0) display = {"cm", 100.0, 2};
  if (unit == "s" && largest < 1.0) display = {"ms", 1e3, 2};
  if (unit == "rad") display = {"deg", 180.0 / kPi, 2};
  const double shown = largest * display.scale;
  if (shown > 0) display.decimals = std::clamp(2 - static_cast<int>(std::floor(std::log10(shown))), 0, 4);
  return display;
}

std::string heading(const std::string& metric, const Display& display) {
  return display.unit.empty() ? metric : metric + " [" + display.unit + "]";
}

void mark_best(const std::vector<TableCell*>& cells, const std::vector<double>& values, metrics::Direction direction) {
  using metrics::Direction;
  if (direction == Direction::target) return;  // the caller does not give the target
  if (direction == Direction::neither || std::ranges::count_if(values, [](double v) { return std::isfinite(v); }) < 2)
    return;
  const auto better = [&](double a, double b) { return direction == Direction::lower_is_better ? a < b : a > b; };
  double best = std::numeric_limits<double>::quiet_NaN();
  for (const double v : values)
    if (std::isfinite(v) && (std::isnan(best) || better(v, best))) best = v;
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i]->best = values[i] == best;
}

}  // namespace scanbench::harness
