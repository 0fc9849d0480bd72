// The support of a line hypothesis, for RANSAC and Hough. An infinite line is near points in all parts of the scan; a
// wall is a sequence of points without a large gap.
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "algorithms/extract/parts/noise_scale.hpp"

namespace scanbench::extract {

/// The largest stretch, in scan order, of points with group -1 that are within their tolerance of the line and at most
/// max_gap_m from their neighbours; of equal ones the first. The last stretch continues in the first if their ends are
/// within max_gap_m (the seam of a full turn). Indices are ascending within a stretch.
std::vector<int> largest_support(std::span<const Vec2> points, std::span<const double> tolerance,
                                 std::span<const int> group, const Vec2& normal, double offset, double max_gap_m);

/// Refits the line to its support by total least squares and takes the support of the refitted line, until it does not
/// change (at most ten times). The result is never smaller than `support`.
std::vector<int> refined_support(std::span<const Vec2> points, std::span<const double> tolerance,
                                 std::span<const int> group, std::vector<int> support, double max_gap_m);

/// Fields for Params with the members max_gap_m, max_lines, sigmas, floor_m, min_points and min_length_m.
template <class P>
auto consensus_fields() {
  return std::tuple_cat(
      std::tuple{
          field("max_gap_m", &P::max_gap_m, above(0), "m", "largest distance of neighbouring points in a support"),
          field("max_lines", &P::max_lines, between(1, 10000), "", "largest number of lines of a scan")},
      noise_fields<P>(), support_fields<P>());
}

}  // namespace scanbench::extract
