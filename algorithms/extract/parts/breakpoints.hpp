// Where a scan is broken before or while lines are sought: thresholds that grow with range, gaps, and the adaptive
// breakpoint detector of Borges & Aldon, "Line extraction in 2D range images for mobile robotics", J. Intelligent and
// Robotic Systems 40, 2004, section 3.1.
#pragma once

#include <string_view>
#include <tuple>
#include <vector>

#include "algorithms/extract/parts/groups.hpp"

#include "core/index.hpp"

namespace scanbench::extract {

/// How a threshold follows the range: point spacing and range error grow with it (Siadat et al. 1997, section 5).
enum class Growth { constant, linear };

/// T(r) = constant, or constant + slope * r.
struct RangeThreshold {
  double constant_m = 0.0;
  double per_m = 0.0;

  RangeThreshold(double threshold_m, Growth growth, double threshold_per_m)
      : constant_m(threshold_m), per_m(growth == Growth::linear ? threshold_per_m : 0.0) {}
  /// At the reading of a beam; a constant threshold does not look at it.
  double at(const Scan& scan, int beam) const {
    return per_m > 0 ? constant_m + per_m * scan.ranges[as_index(beam)] : constant_m;
  }
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

/// Fields for Params with the members threshold_m, threshold (a Growth) and threshold_per_m; `doc` says what is
/// compared with it, `where` at which point's range.
template <class P>
auto threshold_fields(std::string_view doc, std::string_view where) {
  return std::tuple{
      field("threshold_m", &P::threshold_m, at_least(0), "m", doc),
      choice("threshold", &P::threshold, {{Growth::constant, "constant"}, {Growth::linear, "linear"}}, where),
      field("threshold_per_m", &P::threshold_per_m, at_least(0), "m/m", "growth of the linear threshold with range")};
}

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
