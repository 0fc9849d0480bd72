// Lines of groups of scan points: fitting, end points, support and labels. Every line extractor does this after it has
// grouped the points. Siadat et al. 1997, sections 3 (least squares) and 6 (segments).
#pragma once

#include <cstddef>
#include <span>
#include <tuple>
#include <vector>

#include "core/geometry/least_squares.hpp"
#include "core/index.hpp"
#include "core/params.hpp"
#include "core/scan.hpp"

namespace scanbench::extract {

/// The line of a group of points.
enum class Fit {
  end_points,  ///< through the first and the last point
  tls,         ///< orthogonal (total) least squares
  siadat       ///< Siadat et al. 1997, eqs 4-6: exact for collinear points, biased towards larger rho under noise
};

/// Consecutive points of ScanPoints, both ends included. Two neighbouring runs may share a break point, the last of one
/// run and the first of the next.
struct PointRun {
  int first = 0;
  int last = 0;
  int size() const { return last - first + 1; }
  bool operator==(const PointRun&) const = default;
};

inline std::span<const Vec2> points_of(std::span<const Vec2> points, const PointRun& run) {
  return points.subspan(as_index(run.first), as_index(run.size()));
}

/// Conditions on the groups that become lines.
struct SupportRules {
  int min_points = 2;         ///< in the support; 1 also keeps groups without a direction, as segments of length 0
  double min_length_m = 0.0;  ///< of the segment
};

/// Moments of the points with these indices, summed in their order.
PointMoments moments_of(std::span<const Vec2> points, std::span<const int> indices);

/// The line of a group. A group without a direction (one point, equal points, an isotropic cloud) is marked degenerate;
/// its line passes through the centroid perpendicular to the ray from the sensor, so that it rotates with the scan.
/// Fit::siadat falls back to Fit::tls where it is undefined (all points on one ray). No points: degenerate, weight 0.
LineFit fit_group(std::span<const Vec2> points, Fit fit);

/// The lines of runs of points, in order. `runs` are ascending. Both lines at a shared break point are fitted to it and
/// both segments reach it, but it is in the support of the second run only, so that supports are disjoint. A run that
/// does not satisfy the rules gives no line, and the labels of its beams stay -1. Segments have the sensor on their
/// left; end points are the projections of the run's first and last point.
ScanLines lines_of_runs(const Scan& scan, const ScanPoints& points, std::span<const PointRun> runs, Fit fit,
                        SupportRules rules = {});

/// The same with known lines: fits[k] is the line of runs[k]. Its normal, offset, residual_sum and weight are used.
ScanLines lines_of_runs(const Scan& scan, const ScanPoints& points, std::span<const PointRun> runs,
                        std::span<const LineFit> fits, SupportRules rules = {});

/// The lines of arbitrary groups: group_of_point[k] in -1 .. groups-1 is the group of points[k], -1 for none. Lines are
/// in the order of their first beams, independent of the numbers of the groups. End points are the extreme projections
/// of the support, also for a support across the seam of a full turn.
ScanLines lines_of_groups(const Scan& scan, const ScanPoints& points, std::span<const int> group_of_point, int groups,
                          Fit fit, SupportRules rules = {});

// Fields that extractors share. Params has the members, and std::tuple_cat appends the fields.

template <class P>
auto support_fields() {
  return std::tuple{
      field("min_points", &P::min_points, between(1, 1e6), "",
            "smallest number of support points of a line; 1 also keeps single points, as segments of length 0"),
      field("min_length_m", &P::min_length_m, at_least(0), "m", "shortest length of a line; 0 disables the limit")};
}

template <class P>
auto fit_field() {
  return std::tuple{choice("fit", &P::fit,
                           {{Fit::end_points, "end_points"}, {Fit::tls, "tls"}, {Fit::siadat, "siadat"}},
                           "line of a group: through its end points, total least squares, or eqs 4-6 of Siadat et al. "
                           "1997 (least squares weighted by 1/rho)")};
}

}  // namespace scanbench::extract
