// A small picture of one scan with the lines found in it, for pages that show many of them.
#pragma once

#include <string>
#include <vector>

#include "core/geometry/geometry.hpp"

namespace scanbench::results {

enum class SketchLine { right, split, false_line, missed, unjudged, too_small };

/// In the sensor frame, metres.
struct ScanSketch {
  struct Line {
    Segment segment;
    SketchLine kind = SketchLine::unjudged;
  };
  std::vector<Vec2> points;
  std::vector<Line> lines;
  std::string label;  ///< what a screen reader says
};

/// Inline SVG of 4:3: the sensor as a triangle, the points, and the lines in the colours and dashes that figures use
/// for right, split, false and missed lines. Points that are not finite are left out.
std::string scan_sketch(const ScanSketch& sketch);

/// The key to these colours and dashes: a line of HTML.
std::string scan_sketch_key();

}  // namespace scanbench::results
