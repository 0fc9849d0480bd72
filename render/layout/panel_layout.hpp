// The place of a panel's data on paper.
#pragma once

#include <string>
#include <vector>

#include "core/ticks.hpp"
#include "render/paper/shapes.hpp"

namespace scanbench::render {

struct PanelLayout {
  Rect box{};
  double x_min = 0, x_max = 1, y_min = 0, y_max = 1;  ///< of the data at the box's sides
  bool x_log = false, y_log = false;
  std::vector<Tick> x_ticks{}, y_ticks{};
  std::string x_label{}, y_label{};  ///< with the unit of the numbers at the ticks

  /// Maps data to paper. Not finite for a coordinate that is not, or is <= 0 on a log axis.
  Vec2 to_device(const Vec2& data) const;
};

/// True if the point is near enough to be drawn. Coordinates beyond 1e9 are treated as infinite: their differences
/// would overflow between here and paper.
bool drawable(const Vec2& p);

/// Bounding box of the items' drawable coordinates; x0 > x1 if there are none. On log axes only positive ones count.
Rect data_bounds(const Panel& panel);

}  // namespace scanbench::render
