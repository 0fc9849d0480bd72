// Clusters of segments in a few colours, so that neighbours differ.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "render/scene.hpp"

namespace scanbench::render {

/// Colours for clusters at these places: each takes that of seven colours whose nearest use is farthest away. The same
/// places give the same colours.
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

  /// Draws the segments in the colours of their clusters, those without a cluster in grey; an even selection if there
  /// are more than `most`.
  void add_segments(double width_pt, std::size_t most, Panel& panel) const;
  /// Numbers from 1 beside each cluster that has a midpoint inside the panel's range. Returns false and writes none if
  /// there are too many to read.
  bool add_numbers(Panel& panel) const;

 private:
  std::vector<Segment> segments_;
  std::vector<int> cluster_;
  std::vector<Vec2> places_;
  std::vector<Color> colors_;
};

/// An even selection of at most `most` segments or points.
std::vector<Segment> thinned(std::span<const Segment> segments, std::size_t most);
std::vector<Vec2> thinned(std::span<const Vec2> points, std::size_t most);

}  // namespace scanbench::render
