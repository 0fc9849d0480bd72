// The segments that maps and scans are made of while they are merged.
#pragma once

#include <vector>

#include "algorithms/map/dse/merging.hpp"

namespace scanbench::mapping::dse {

/// A segment of the map or of an aligned scan, with the evidence for it. Evidence is shared out when a segment is cut
/// or has several children, and added up when segments are merged, so that its sum over a map is what was inserted.
struct Stroke {
  Segment segment;
  int created = 0;       ///< step at which it was made
  double members = 0.0;  ///< scan lines
  double points = 0.0;   ///< scan points
  int cut_of = -1;       ///< of the pieces of a stroke while map and scan are paired: the stroke's index
};

/// What decides where the line of two merged strokes lies.
enum class Placement {
  by_length,   ///< the paper's d1 l1 = d2 l2: a wall moves half the distance to where the last scan saw it
  by_evidence  ///< d1 p1 = d2 p2 with the numbers of points: a wall is where all its scans saw it on average
};

/// The weights of two strokes; their lengths where they have no points.
inline Weights weights_of(const Stroke& s, const Stroke& t, Placement placement) {
  if (placement == Placement::by_evidence && s.points > 0 && t.points > 0) return {s.points, t.points};
  return lengths_of(s.segment, t.segment);
}

}  // namespace scanbench::mapping::dse
