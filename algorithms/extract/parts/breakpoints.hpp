// Breaks between neighbouring points: thresholds that grow with range, gaps, and the adaptive breakpoint detector of
// Borges & Aldon, "Line extraction in 2D range images for mobile robotics", J. Intelligent and Robotic Systems 40,
// 2004, section 3.1.
#pragma once

#include <string_view>
#include <tuple>
#include <vector>

#include "algorithms/extract/parts/groups.hpp"

#include "core/index.hpp"

namespace scanbench::extract {

/// Growth of a threshold with range: point spacing and range error grow with it too (Siadat et al. 1997, section 5).
enum class Growth { constant, linear };

/// T(r) = constant, or constant + slope * r.
struct RangeThreshold {
  double constant_m = 0.0;
  double per_m = 0.0;

  RangeThreshold(double threshold_m, Growth growth, double threshold_per_m)
      : constant_m(threshold_m), per_m(growth == Growth::linear ? threshold_per_m : 0.0) {}
  /// The threshold at the range of a beam. A constant threshold does not read the range.
  double at(const Scan& scan, int beam) const {
    return per_m > 0 ? constant_m + per_m * scan.ranges[as_index(beam)] : constant_m;
  }
};

/// Adaptive breakpoint detector: neighbours farther apart than
///   D_max = r sin(dphi) / sin(lambda - dphi) + 3 sigma_r
/// are on different surfaces, unless the angle between surface and beam is below lambda. r is the smaller of the two
/// ranges, dphi the angle between neighbouring beams, sigma_r the range noise of the sensor.
///
/// Across missing beams dphi is still one step. The angle between the two beams would give a limit that grows without
/// bound as that angle approaches lambda: 19 r across 19 beams of half a degree. With one step, a surface that faces
/// the sensor continues across a few missing beams, an oblique one across fewer, and no jump in range is larger than
/// between neighbours. Across more than kMostMissingBeams nothing continues.
class AdaptiveBreakpoint {
 public:
  explicit AdaptiveBreakpoint(double lambda_rad);
  /// Consecutive beams without a return that do not end a surface by themselves. A sensor that loses one return in ten
  /// loses more than four in a row once in 100 000 beams; an opening is wider.
  static constexpr int kMostMissingBeams = 4;

  /// Largest distance of two points on one surface, given by their beams, beam < next_beam; 0 across too many missing
  /// beams, and for dphi >= lambda, where the detector is not defined.
  double max_distance(const Scan& scan, int beam, int next_beam) const;

 private:
  double sin_lambda_;
  double cos_lambda_;
};

/// Gaps at which a scan is divided before lines are extracted.
struct GapRules {
  double max_gap_m = 0.0;      ///< largest distance of neighbours in a run; 0 disables the limit
  int max_missing_beams = -1;  ///< most beams without a return between neighbours in a run; -1 disables the limit
};

/// Runs of points without a gap, in order; one run of all points if both limits are disabled. No points: no runs.
std::vector<PointRun> runs_between_gaps(const ScanPoints& points, const GapRules& rules);

/// Runs of points between the breakpoints of the adaptive detector.
std::vector<PointRun> runs_between_breakpoints(const Scan& scan, const ScanPoints& points,
                                               const AdaptiveBreakpoint& detector);

/// Fields for Params with the members threshold_m, threshold (a Growth) and threshold_per_m. `doc` says what the
/// threshold limits, `where` at which range it is taken.
template <class P>
auto threshold_fields(std::string_view doc, std::string_view where) {
  return std::tuple{
      field("threshold_m", &P::threshold_m, at_least(0), "m", doc),
      choice("threshold", &P::threshold, {{Growth::constant, "constant"}, {Growth::linear, "linear"}}, where),
      field("threshold_per_m", &P::threshold_per_m, at_least(0), "m/m", "increase of the linear threshold with range")};
}

/// Fields for Params with the members max_gap_m and max_missing_beams.
template <class P>
auto gap_fields() {
  return std::tuple{field("max_gap_m", &P::max_gap_m, at_least(0), "m",
                          "largest distance of neighbouring points of a line; 0 disables the limit"),
                    field("max_missing_beams", &P::max_missing_beams, between(-1, 1e6), "",
                          "largest number of consecutive beams without a return within a line; -1 disables the limit")};
}

/// Field for Params with the member lambda_rad.
template <class P>
auto lambda_field() {
  return std::tuple{field("lambda_rad", &P::lambda_rad, between(0.001, 1.5), "rad",
                          "adaptive breakpoints: smallest angle between beam and surface at which neighbours are not "
                          "separated; 10 degrees in Borges & Aldon 2004")};
}

}  // namespace scanbench::extract
