// Incremental line extraction: a point joins the line under way if the line refitted with it is still straight within
// the sensor's noise; else it is put back and begins the next line. Nguyen et al., Autonomous Robots 23, 2007, the
// algorithm "Incremental"; neighbours that turn out collinear are merged, as there.
//
// Straight is: the point itself within `sigmas` standard deviations of the refitted line, and the residuals of all
// within one and a half (their root mean square over at least 5 points): both cost O(1) per point.
#include <cmath>

#include "algorithms/extract/breakpoints.hpp"
#include "algorithms/extract/noise_scale.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

using namespace extract;

class Incremental final : public LineExtractor {
 public:
  struct Params {
    double sigmas = 3.0;
    double floor_m = 0.01;
    double lambda_rad = radians(10.0);
    double merge_gap_m = 0.3;
    int min_points = 5;
    double min_length_m = 0.1;

    static auto fields() {
      return std::tuple_cat(noise_fields<Params>(), lambda_field<Params>(), merge_gap_field<Params>(),
                            support_fields<Params>());
    }
  };

  explicit Incremental(const Params& params) : params_(params), breakpoint_(params.lambda_rad) {}

  ScanLines extract(const Scan& scan, Trace& trace) const override {
    trace.stage("pre");
    const ScanPoints points = valid_points(scan);
    const std::vector<double> tolerance = tolerances(scan, points, {params_.sigmas, params_.floor_m});
    trace.stage("segment");
    std::vector<PointRun> runs;
    for (const PointRun& contour : runs_between_breakpoints(scan, points, breakpoint_))
      grow(points, tolerance, contour, runs);
    trace.stage("merge");
    runs = merge_neighbours(points.points, tolerance, runs, params_.merge_gap_m);
    trace.stage("post");
    return lines_of_disjoint_runs(scan, points, tolerance, runs, params_.merge_gap_m,
                                  {params_.min_points, params_.min_length_m});
  }

 private:
  void grow(const ScanPoints& points, std::span<const double> tolerance, const PointRun& contour,
            std::vector<PointRun>& runs) const {
    int first = contour.first;
    PointMoments line;
    for (int i = first; i <= contour.last; ++i) {
      const auto k = static_cast<std::size_t>(i);
      PointMoments with = line;
      with.add(points.points[k]);
      if (i - first >= 2 && !straight(fit_line(with), points.points[k], tolerance[k], i - first + 1)) {
        runs.push_back({first, i - 1});
        first = i;
        line = PointMoments();
        line.add(points.points[k]);
      } else {
        line = with;
      }
    }
    runs.push_back({first, contour.last});
  }

  bool straight(const LineFit& line, const Vec2& newest, double tolerance, int count) const {
    if (line.degenerate) return true;
    if (line.distance(newest) > tolerance) return false;
    return count < 5 || line.rms() <= 0.5 * tolerance;
  }

  Params params_;
  AdaptiveBreakpoint breakpoint_;
};

const bool registered = Registry<LineExtractor>::add<Incremental>(
    {.name = "incremental",
     .summary = "Incremental: grows a line while the refit with the next point stays straight",
     .reference = "Nguyen et al. 2007, Autonomous Robots 23, algorithm Incremental"});

}  // namespace
}  // namespace scanbench
