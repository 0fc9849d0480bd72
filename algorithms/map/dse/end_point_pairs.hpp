// Correspondence: end points of the scan's segments with closest points of the map, after vertices have been inserted
// (Lakaemper, Latecki & Wolter 2005, sections 2 and 3.1).
#pragma once

#include <span>
#include <vector>

#include "algorithms/map/dse/strokes.hpp"
#include "algorithms/map/dse/vertex_insertion.hpp"
#include "algorithms/map/parts/registration.hpp"

namespace scanbench::mapping::dse {

struct CorrespondenceRule {
  InsertionRule insertion{};
  double extent_m = 0.2;    ///< how far beyond a segment's ends a point may project
  double angle_rad = 0.35;  ///< largest angle between a scan segment and its partner
  bool same_side = true;    ///< partners must be seen from the same side
};

/// Pairs at a pose: the scan's segments, cut at the projections of the map's ends (the correspondences with exchanged
/// roles), give their end points, each with the nearest line of the map of about its direction within the gate. A point
/// has half the length of its piece as weight. Departure from the paper, which pulls points to points: an end that an
/// occlusion made is nowhere in the world, so that residuals count across the map's line only.
std::vector<PointOnLine> end_point_pairs(std::span<const Stroke> scan, std::span<const Stroke> map,
                                         const Pose2& map_from_sensor, double gate_m, const CorrespondenceRule& rule);

}  // namespace scanbench::mapping::dse
