// Where a scan is broken before or while lines are sought: thresholds that grow with range, gaps, and the adaptive
// breakpoint detector of Borges & Aldon, "Line extraction in 2D range images for mobile robotics", J. Intelligent and
// Robotic Systems 40, 2004, section 3.1.
#pragma once

#include <tuple>
#include <vector>

#include "algorithms/extract/groups.hpp"

namespace scanbench::extract {

/// T(r) = constant + slope * r: point spacing and range error grow with range (Siadat et al. 1997, section 5).
struct RangeThreshold {
  double constant_m = 0.0;
  double per_m = 0.0;
  double operator()(double range_m) const { return constant_m + per_m * range_m; }
};

/// Adaptive breakpoint detector: neighbours farther apart than
///   D_max = r sin(dphi) / sin(lambda - dphi) + 3 sigma_r
/// lie on different surfaces, unless the surface makes an angle below lambda with the beam. r is the smaller of the two
/// ranges, dphi the angle between the two beams (missing beams in between widen it), sigma_r the sensor's.
class AdaptiveBreakpoint {
 public:
  explicit AdaptiveBreakpoint(double lambda_rad);
  /// Largest distance of two points on one surface; 0 where dphi >= lambda, where the detector says nothing.
  double max_distance(const Scan& scan, int beam, int next_beam) const;

 private:
  double sin_lambda_;
  double cos_lambda_;
};

/// Where neighbouring points are taken apart before any line is sought.
struct GapRules {
  double max_gap_m = 0.0;      ///< largest distance of neighbours in a run; 0: any
  int max_missing_beams = -1;  ///< most beams without a return between neighbours in a run; -1: any
};

/// Runs of points without a gap, in order; all points in one run when the rules are off. No points: no runs.
std::vector<PointRun> runs_between_gaps(const ScanPoints& points, const GapRules& rules);

/// Runs of points between the breakpoints of the adaptive detector.
std::vector<PointRun> runs_between_breakpoints(const Scan& scan, const ScanPoints& points,
                                               const AdaptiveBreakpoint& detector);

/// Fields for Params with the members max_gap_m and max_missing_beams.
template <class P>
auto gap_fields() {
  return std::tuple{field("max_gap_m", &P::max_gap_m, at_least(0), "m",
                          "a line ends where neighbouring points are farther apart than this; 0: it does not"),
                    field("max_missing_beams", &P::max_missing_beams, between(-1, 1e6), "",
                          "a line ends where more beams than this in a row have no return; -1: it does not")};
}

/// Field for Params with the member lambda_rad.
template <class P>
auto lambda_field() {
  return std::tuple{field("lambda_rad", &P::lambda_rad, between(0.001, 1.5), "rad",
                          "adaptive breakpoints: smallest angle between beam and surface at which neighbours stay "
                          "together; 10 degrees in Borges & Aldon 2004")};
}

}  // namespace scanbench::extract
