// Whether the points of scans can be seen beside the lines that are drawn over them.
#pragma once

#include <span>

#include "render/scene.hpp"

namespace scanbench::render {

/// True if one in a hundred of the points or more is beside all segments in a picture of this scene: farther from them
/// than half of `stroke_pt`, on the paper of the first panel, and in a column of half the width too. `scene` needs its
/// sizes, its columns and the ranges of its panels, but no items. False without points.
bool seen_beside(std::span<const Vec2> points, std::span<const Segment> segments, double stroke_pt, const Scene& scene);

}  // namespace scanbench::render
