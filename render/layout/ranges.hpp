// The ranges of a panel's axes.
#pragma once

#include "render/layout/panel_layout.hpp"

namespace scanbench::render {

/// The panel's own ranges, else those of `data` with a margin. Ranges of logarithmic axes are positive.
void set_ranges(const Panel& panel, const Rect& data, PanelLayout& place);

/// Widens one range about its middle so that a unit is as long in x as in y.
void equalise(PanelLayout& place);

}  // namespace scanbench::render
