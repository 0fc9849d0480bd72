// A chart of points with names, for pages: accuracy against time.
#pragma once

#include <string>
#include <vector>

namespace scanbench::results {

struct ScatterPoint {
  double x = 0.0;  ///< above 0: the axis is logarithmic
  double y = 0.0;
  std::string name;
  bool on_front = false;  ///< filled, and joined with the others on the front by steps
};

struct ScatterChart {
  std::string x_label;  ///< with unit
  std::string y_label;
  std::vector<ScatterPoint> points;
};

/// Inline SVG of 480 x 300 px in the colours of the page. Every point has its name as a hint; the name is beside it
/// where there is room, those of the front first. The y axis is logarithmic too if all y are above 0 and span more than
/// a factor of 30. Points that cannot be drawn (not finite, x not above 0) are left out; the text is empty if none is
/// left.
std::string scatter_chart(const ScatterChart& chart);

}  // namespace scanbench::results
