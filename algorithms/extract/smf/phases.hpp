// The two phases of split-and-merge fuzzy (SMF) line extraction, for any ordered points: Borges & Aldon, "A
// split-and-merge segmentation algorithm for line extraction in 2-D range images", ICPR 2000, section 3.
#pragma once

#include <span>
#include <vector>

#include "algorithms/extract/parts/fuzzy_clustering.hpp"
#include "core/geometry/least_squares.hpp"
#include "core/trace/trace.hpp"

namespace scanbench::extract {

/// Ways to halve the support of a line, which initialises the fuzzy clustering with C = 2. The paper leaves this open.
enum class SmfInitialisation {
  scan_order,      ///< first and second half of the points
  principal_axis,  ///< first and second half along the line
  farthest,        ///< at the point farthest from the chord
};

struct SmfOptions {
  double sigma_max_m = 0.05;
  FuzzyOptions fuzzy{};
  bool penalty_in_dispersion = false;  ///< d of eq. (11) with the term g; docs/algorithms/smf.md shows the effect
  SmfInitialisation initialisation = SmfInitialisation::scan_order;
  double max_gap_m = 0.0;  ///< largest gap along a fused line; 0 disables the limit
};

/// A line: ascending indices of its support points, and their moments.
struct SmfLine {
  std::vector<int> support;
  PointMoments moments;
};

/// sigma_k, eq. (11) [m]; 0 for up to two points, unless it includes the penalty.
double smf_dispersion(const PointMoments& moments, const SmfOptions& options);

/// Split phase. The supports partition the indices of `points` (in scan order, metres, finite). Every line has a
/// dispersion of at most sigma_max_m, or at most two points. No points: no lines.
std::vector<SmfLine> smf_split(std::span<const Vec2> points, const SmfOptions& options, Trace& trace);

/// Merge phase. Ends when no line can be fused with either of the two lines whose centres are nearest to its own.
std::vector<SmfLine> smf_merge(std::span<const Vec2> points, std::vector<SmfLine> lines, const SmfOptions& options,
                               Trace& trace);

}  // namespace scanbench::extract
