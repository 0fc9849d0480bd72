// Point-to-line registration of two scans: the matcher `plicp`, and the start of `optimal_match`.
#pragma once

#include "algorithms/match/parts/pairs.hpp"
#include "core/trace/trace.hpp"

namespace scanbench::matching {

struct RegistrationRules {
  double gate_m = 0.5;       ///< farthest partner
  double keep = 0.9;         ///< share of the pairs, the nearest ones, that counts until the pose is near
  double trim = 4.5;         ///< then pairs count up to so many times the median residual
  bool by_noise = true;      ///< that median is of residuals in standard deviations; else of residuals in metres
  double min_overlap = 0.3;  ///< share of the current returns that must have a partner
  int max_iterations = 30;
  bool held = false;  ///< the result is held against the guess, see conclusion()
};

/// Gauss-Newton on the distances of the current returns, each moved onto its own local line, from the local lines of
/// their nearest returns in the reference. The weights follow from the noise across the lines. Pairs whose local lines
/// differ by more than 20 degrees are on two sides of a corner and are left out. Motions that the lines leave open stay
/// as in the guess.
Match register_points_on_lines(const ReturnedPoints& reference, const std::vector<LocalLine>& lines,
                               const ReturnedPoints& current, const std::vector<LocalLine>& current_lines,
                               const Guess& guess, const RegistrationRules& rules, Trace& trace);

}  // namespace scanbench::matching
