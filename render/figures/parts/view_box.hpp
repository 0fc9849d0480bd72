// The part of the plane that a panel shows.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "render/scene.hpp"

namespace scanbench::render {

/// Sets ranges that contain all of `must_hold` and the bulk of `points`, with a margin: stray points far away from all
/// others do not shrink the rest. Without any finite point no ranges are set.
void set_view(std::span<const Vec2> points, std::span<const Vec2> must_hold, Panel& panel);

/// Both ends of each segment.
std::vector<Vec2> ends_of(std::span<const Segment> segments);

/// A part of a map: a square, or a rectangle with `side` in x.
struct Window {
  Vec2 center = Vec2::Zero();
  double side = 1.0;
  double aspect = 1.0;  ///< height over width
  Vec2 half() const { return {0.5 * side, 0.5 * side * aspect}; }
  bool contains(const Vec2& p) const { return ((p - center).cwiseAbs().array() <= half().array()).all(); }
  /// True if the bounding box of the segment and the window overlap.
  bool is_near(const Segment& s) const {
    const Vec2 low = s.a.cwiseMin(s.b) - center, high = s.a.cwiseMax(s.b) - center;
    return (low.array() <= half().array()).all() && (high.array() >= -half().array()).all();
  }
  void set_ranges(Panel& panel) const;
  /// Its outline, on a panel that shows more.
  Polyline outline() const;
};

/// The smallest square that contains the segments, with a margin; none without finite ones.
std::optional<Window> square_around(std::span<const Segment> segments);

/// Of the squares of this side around one of the places, the one that contains the most, centred on these; the first of
/// equals.
std::optional<Window> fullest_window(std::span<const Vec2> places, double side);

/// Larger side of the bounding box; 0 without finite ends.
double extent_of(std::span<const Segment> segments);

}  // namespace scanbench::render
