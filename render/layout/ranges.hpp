// The ranges of a panel's axes.
#pragma once

#include "render/layout/panel_layout.hpp"

namespace scanbench::render {

/// The panel's own ranges, else those of `data` with a margin. Ranges of logarithmic axes are positive.
void set_ranges(const Panel& panel, const Rect& data, PanelLayout& place);

/// The least share of a box that its data have; letters beside them must do with the rest.
inline constexpr double kLeastDataShare = 0.3;

/// Widens the ranges so that a unit is as long in x as in y: by the room for letters around the data, and one range
/// about its middle.
void equalise(const LetterRoom& room, double em, PanelLayout& place);

}  // namespace scanbench::render
