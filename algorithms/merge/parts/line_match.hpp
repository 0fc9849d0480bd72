// The pairwise relation of the baselines of segment merging: two segments match if they are nearly parallel, close to
// each other across their common direction, and overlap along it (after Amigoni & Gasparini, "Analysis of methods for
// reducing line segments in maps", IROS 2008, as described in Lakaemper 2009, section II).
#pragma once

#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "algorithms/merge/parts/joint_space.hpp"
#include "algorithms/merge/parts/point_grid.hpp"
#include "core/modules.hpp"
#include "core/params.hpp"

namespace scanbench::merge {

struct MatchTolerance {
  double angle_rad;   ///< largest difference of direction
  double distance_m;  ///< largest distance of the midpoints across the common direction
  double gap_m;       ///< largest gap along it; 0: they must touch
};

/// Fields for Params with the members max_angle_deg, max_distance_m and max_gap_m.
template <class P>
auto match_fields() {
  return std::tuple{field("max_angle_deg", &P::max_angle_deg, between(0, 90), "deg",
                          "largest difference of direction of two matching segments"),
                    field("max_distance_m", &P::max_distance_m, at_least(0), "m",
                          "largest distance of their midpoints across their common direction"),
                    field("max_gap_m", &P::max_gap_m, at_least(0), "m",
                          "largest gap between their projections; 0: they must overlap or touch")};
}

/// The tolerances of such Params.
template <class P>
MatchTolerance match_tolerance(const P& p) {
  return {.angle_rad = radians(p.max_angle_deg), .distance_m = p.max_distance_m, .gap_m = p.max_gap_m};
}

/// A segment that represents one or more lines, with the sums that determine it.
struct Representative {
  Segment segment;
  double weight = 0.0;          ///< sum of the lengths
  Vec2 doubled = Vec2::Zero();  ///< sum of length * (cos 2 theta, sin 2 theta)
  Vec2 middle = Vec2::Zero();   ///< length-weighted mean midpoint
};

Representative representative_of(const Segment& segment, double multiplicity);

/// The segment that represents both. Its direction is the length-weighted mean of the undirected directions, its
/// position is the length-weighted mean of the midpoints, and its extent covers the projections of both.
Representative united(const Representative& a, const Representative& b);

/// Mismatch of the two, from 0 (collinear) to 2; nothing if they do not match. Symmetric.
std::optional<double> match_cost(const Representative& a, const Representative& b, const MatchTolerance& rules);

/// The usable lines without repetitions, in an order that does not depend on the given order.
struct DistinctLines {
  std::vector<Representative> representatives;
  std::vector<int> of_line;  ///< representative of each input line; -1: unusable
};
DistinctLines distinct_lines(std::span<const MapLine> lines);

/// The pairs of segments that may match, from a grid of points along the segments.
class NearSegments {
 public:
  NearSegments(std::span<const Representative> segments, const MatchTolerance& rules);

  /// Calls visit(j) for every j > i that may match i. The same j may be visited several times.
  template <class Visit>
  void for_each_after(std::size_t i, Visit&& visit) const {
    for (std::size_t k = first_[i]; k < first_[i + 1]; ++k)
      grid_->for_each_near(points_[k], Vec3::Zero(), reach_, [&](std::size_t other, const Vec3&) {
        if (owner_[other] > i) visit(owner_[other]);
      });
  }

 private:
  std::vector<Vec3> points_;
  std::vector<std::size_t> owner_;
  std::vector<std::size_t> first_;
  double reach_ = 0.0;
  std::optional<PointGrid> grid_;
};

/// The map and the labels. Representative r is in group[r] (numbered from 0), and groups[g] represents group g.
MergeResult result_of(std::span<const MapLine> lines, const DistinctLines& distinct, const std::vector<int>& group,
                      const std::vector<Representative>& groups);

}  // namespace scanbench::merge
