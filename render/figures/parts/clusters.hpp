// Clusters of segments that can be told apart although there are more of them than colours.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "render/figures/parts/common.hpp"

namespace scanbench::render {

/// Colours for clusters at these places: of seven, each takes the one that stands farthest away. The same places give
/// the same colours.
std::vector<Color> cluster_colors(std::span<const Vec2> places);

/// Segments with the cluster of each, -1: none.
class ClusteredSegments {
 public:
  ClusteredSegments(std::vector<Segment> segments, std::vector<int> cluster);

  std::size_t clusters() const { return places_.size(); }
  const std::vector<Segment>& segments() const { return segments_; }
  int cluster_of(std::size_t segment) const { return cluster_[segment]; }
  const std::vector<Color>& colors() const { return colors_; }
  const std::vector<Vec2>& places() const { return places_; }  ///< means of midpoints

  /// The segments in the colours of their clusters, those of none in grey; evenly taken ones if there are more than
  /// `most`.
  void add_segments(double width_pt, std::size_t most, Panel& panel) const;
  /// Numbers from 1 beside each cluster that has a midpoint inside the panel's range. False: there are too many
  /// to read, none is written.
  bool add_numbers(Panel& panel) const;

 private:
  std::vector<Segment> segments_;
  std::vector<int> cluster_;
  std::vector<Vec2> places_;
  std::vector<Color> colors_;
};

/// A square part of a map.
struct Window {
  Vec2 center = Vec2::Zero();
  double side = 1.0;
  bool contains(const Vec2& p) const { return ((p - center).cwiseAbs().array() <= 0.5 * side).all(); }
  void set_ranges(Panel& panel) const;
  /// Its outline, on a panel that shows more.
  Polyline outline() const;
};
/// The smallest square that holds the segments, with a margin; none without finite ones.
std::optional<Window> square_around(std::span<const Segment> segments);
/// The one of this side that holds the most places around one of them, centred on those it holds; the first of equals.
std::optional<Window> fullest_window(std::span<const Vec2> places, double side);

/// At most `most` segments, evenly taken.
std::vector<Segment> thinned(std::span<const Segment> segments, std::size_t most);

/// An empty panel says why it is empty.
void add_note(const std::string& text, Panel& panel);

/// Larger side of the bounding box; 0 without finite ends.
double extent_of(std::span<const Segment> segments);

}  // namespace scanbench::render
