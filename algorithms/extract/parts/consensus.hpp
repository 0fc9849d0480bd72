// Points that support a line hypothesis: what RANSAC and Hough share. An infinite line meets points all over the scan;
// a wall is a stretch of them without a large gap.
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "algorithms/extract/parts/noise_scale.hpp"

namespace scanbench::extract {

/// Of the points with group -1 within their tolerance of the line, the largest stretch in scan order whose neighbours
/// are at most max_gap_m apart; the first of equals. The last stretch goes on in the first where their ends are that
/// near (the seam of a full turn). Indices ascend.
std::vector<int> largest_support(std::span<const Vec2> points, std::span<const double> tolerance,
                                 std::span<const int> group, const Vec2& normal, double offset, double max_gap_m);

/// The support of the line refitted to its own support by total least squares, until it does not change (at most ten
/// times), starting from `support`. Never returns a smaller set than it was given.
std::vector<int> refined_support(std::span<const Vec2> points, std::span<const double> tolerance,
                                 std::span<const int> group, std::vector<int> support, double max_gap_m);

/// Fields for Params with the members max_gap_m, max_lines, sigmas, floor_m, min_points and min_length_m.
template <class P>
auto consensus_fields() {
  return std::tuple_cat(std::tuple{field("max_gap_m", &P::max_gap_m, above(0), "m",
                                         "a support ends where its neighbouring points are farther apart"),
                                   field("max_lines", &P::max_lines, between(1, 10000), "", "lines of a scan at most")},
                        noise_fields<P>(), support_fields<P>());
}

}  // namespace scanbench::extract
