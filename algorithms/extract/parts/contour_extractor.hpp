// The common steps of three algorithms of Nguyen et al., "A comparison of line extraction algorithms using 2D range
// data for indoor mobile robotics", Autonomous Robots 23, 2007: contours between adaptive breakpoints are cut into
// straight runs, each algorithm with its own rule; collinear neighbours are merged; lines are fitted by least squares.
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "algorithms/extract/parts/breakpoints.hpp"
#include "algorithms/extract/parts/noise_scale.hpp"
#include "core/modules.hpp"

namespace scanbench::extract {

/// Fields for Params with the members of ContourExtractor::Params.
template <class P>
auto contour_fields() {
  return std::tuple_cat(noise_fields<P>(), lambda_field<P>(), merge_gap_field<P>(), support_fields<P>());
}

class ContourExtractor : public LineExtractor {
 public:
  struct Params {
    double sigmas = 3.0;
    double floor_m = 0.01;
    double lambda_rad = radians(10.0);
    double merge_gap_m = 0.3;
    int min_points = 5;
    double min_length_m = 0.1;
    static auto fields() { return contour_fields<Params>(); }
  };

  explicit ContourExtractor(const Params& params) : params_(params), breakpoint_(params.lambda_rad) {}
  ScanLines extract(const Scan& scan, Trace& trace) const final;

 protected:
  /// Appends the straight runs of one contour. They are in order and disjoint and contain every point. tolerance[k] is
  /// the largest distance of points[k] from its line.
  virtual void cut(std::span<const Vec2> points, std::span<const double> tolerance, const PointRun& contour,
                   std::vector<PointRun>& runs) const = 0;
  /// True if cut() compares every point with its tolerance. Lines have covariances only in this case.
  virtual bool tests_every_point() const { return true; }

 private:
  Params params_;
  AdaptiveBreakpoint breakpoint_;
};

}  // namespace scanbench::extract
