// Pairs of returns of two scans, and which of them count.
#pragma once

#include <cstddef>
#include <vector>

#include "algorithms/match/parts/guess.hpp"
#include "algorithms/match/parts/nearest_return.hpp"
#include "algorithms/match/parts/pose_information.hpp"
#include "algorithms/match/parts/scan_points.hpp"

namespace scanbench::matching {

/// A return of the current scan and the return of the reference that is nearest to it.
struct Pair {
  std::size_t current = 0;
  std::size_t reference = 0;
  Vec2 point = Vec2::Zero();  ///< the current return, in the reference frame
  double residual = 0.0;      ///< what the matcher minimises: a distance [m] or its square
  double sigma_m = 0.0;       ///< noise of the current return across its partner's line, once set_noise was called
};

/// The nearest return within `gate_m` of every `every`th current one. `tracks`, one per current return, carry the
/// partners from call to call.
std::vector<Pair> nearest_pairs(const ReturnedPoints& current, const Pose2& reference_from_current, double gate_m,
                                NearestReturn& reference, std::vector<Track>& tracks, std::size_t every = 1);

/// Removes pairs without a local line at both ends and pairs whose lines differ by more than 20 degrees: their ends are
/// on two sides of a corner.
void keep_aligned(std::vector<Pair>& pairs, const std::vector<LocalLine>& lines,
                  const std::vector<LocalLine>& current_lines, const Pose2& reference_from_current);

/// The least ratio of a motion's information to the information that errors of the normals give an open motion. For an
/// open motion the ratio has the mean 1, over the dozens of independent windows of a scan.
inline constexpr double kLeastRatioOfPoints = 5.0;

/// Keeps the `share` of the pairs with the smallest |residual|.
void keep_nearest(std::vector<Pair>& pairs, double share);

/// Sets the noise of each current return across its partner's line.
void set_noise(std::vector<Pair>& pairs, const ReturnedPoints& current, const std::vector<LocalLine>& lines,
               const Pose2& reference_from_current);

/// Keeps the pairs whose |residual|, or |residual| / sigma if `by_noise` (needs set_noise), is at most `times` the
/// median. More than half remain if times >= 1.
void trim(std::vector<Pair>& pairs, double times, bool by_noise);

/// The information about the pose in pairs whose reference has a local line, by the noise of the current scan alone.
/// Needs set_noise.
struct PairInformation {
  PoseEquations equations;
  double misfit = 0.0;  ///< sum of squared residuals from the local lines, in standard deviations of both scans
  int count = 0;
};
PairInformation pair_information(const std::vector<Pair>& pairs, const std::vector<LocalLine>& lines,
                                 const Pose2& reference_from_current);

/// The result for scans that have too little in common.
Match no_match(const Pose2& guess);

/// The result of a matcher of points: status, pose with open motions as in the guess, covariance. `settled`: the
/// iterations converged.
///
/// If `held`, the result is held against the guess. Few returns, on things that moved or on the jamb of another door,
/// can pull a pose along a motion that hardly any others determine, and their residuals are small afterwards. Where the
/// position is outside of 95 % of those that the guess allows, a motion that the pairs do not know five times better
/// than the guess does is therefore open. If the position is still outside, the rest is added to the covariance.
Match conclusion(const PairInformation& information, const Pose2& reference_from_current, const Guess& guess, bool held,
                 double lever_m, bool settled);

}  // namespace scanbench::matching
