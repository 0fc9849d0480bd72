// The frame that three algorithms of Nguyen et al., "A comparison of line extraction algorithms using 2D range data for
// indoor mobile robotics", Autonomous Robots 23, 2007, share: contours between adaptive breakpoints, each cut into
// straight runs in the algorithm's own way, collinear neighbours merged, least squares.
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
  /// Appends the straight runs of one contour: in order, without a common point, every point in one of them.
  /// tolerance[k] is the largest distance of points[k] from its line.
  virtual void cut(std::span<const Vec2> points, std::span<const double> tolerance, const PointRun& contour,
                   std::vector<PointRun>& runs) const = 0;
  /// Whether cut() holds the points against their tolerance: lines then have covariances.
  virtual bool tests_every_point() const { return true; }

 private:
  Params params_;
  AdaptiveBreakpoint breakpoint_;
};

}  // namespace scanbench::extract
