// Computes ranges from the data, with margins.
#include "render/layout/ranges.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scanbench::render {
namespace {

struct Range {
  double low, high;
};

/// The range of one axis: its own, else that of the data with a margin.
Range axis_range(const Axis& axis, double low, double high, double margin) {
  if (axis.range) low = axis.range->first, high = axis.range->second;
  const bool usable = std::isfinite(low) && std::isfinite(high) && low <= high && (!axis.log || low > 0);
  if (!usable) return axis.log ? Range{0.1, 10.0} : Range{0.0, 1.0};
  if (axis.range && low < high) return {low, high};
  if (axis.log) {
    const double grow = low < high ? std::pow(high / low, margin) : 2.0;
    return {low / grow, high * grow};
  }
  const double grow = low < high ? margin * (high - low) : std::max(0.5, 1e-6 * std::abs(low));
  return {low - grow, high + grow};
}

bool has_bars(const Panel& panel) {
  return std::any_of(panel.items.begin(), panel.items.end(),
                     [](const Item& item) { return std::holds_alternative<Bars>(item); });
}

}  // namespace

void set_ranges(const Panel& panel, const Rect& data, PanelLayout& place) {
  const double span = std::max(data.x1 - data.x0, data.y1 - data.y0);
  const auto margin = [&](double extent) {  // equal aspect: the same on all four sides
    return panel.equal_aspect && extent > 0 ? std::min(0.05 * span / extent, 10.0) : 0.05;
  };
  const Range x = axis_range(panel.x, data.x0, data.x1, margin(data.x1 - data.x0));
  Range y = axis_range(panel.y, data.y0, data.y1, margin(data.y1 - data.y0));
  if (!panel.y.range && !panel.y.log && has_bars(panel) && data.y0 == 0) y.low = 0;  // bars begin at the axis
  place.x_min = x.low, place.x_max = x.high, place.y_min = y.low, place.y_max = y.high;
  place.x_log = panel.x.log, place.y_log = panel.y.log;
}

void equalise(const LetterRoom& room, double em, PanelLayout& place) {
  // One side of the box: what is left of it for the data, and the share of the rest that is before them.
  struct Side {
    double length, data, share;
    Side(double box, double before, double after)
        : length(box),
          data(std::max(box - before - after, kLeastDataShare * box)),
          share(before + after > 0 ? before / (before + after) : 0.5) {}
    /// Data units to add before and after an extent that is `unit` points long per data unit.
    std::pair<double, double> grow(double extent, double unit) const {
      const double slack = 0.5 * (data - extent * unit), letters = length - data;
      return {(slack + share * letters) / unit, (slack + (1.0 - share) * letters) / unit};
    }
  };
  const Side x(place.box.width(), room.left * em, room.right * em);
  const Side y(place.box.height(), room.below * em, room.above * em);
  const double dx = place.x_max - place.x_min, dy = place.y_max - place.y_min;
  const double unit = std::min(x.data / dx, y.data / dy);
  const auto [left, right] = x.grow(dx, unit);
  const auto [below, above] = y.grow(dy, unit);
  place.x_min -= left, place.x_max += right;
  place.y_min -= below, place.y_max += above;
}

}  // namespace scanbench::render
