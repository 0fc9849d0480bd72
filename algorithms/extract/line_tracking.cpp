// line_tracking (LT): extends a line point by point. The line ends at the first point that is too far from the
// least-squares line of the points before it. Siadat et al. 1997, section 4 and fig. 5; Borges & Aldon 2000, section
// 2.1.
//
// The papers leave two things open. "Linear regression" is total least squares here, because a regression of y on x
// fails on walls along y, which Siadat's section 6 avoids as well. A range jump alone does not end a line unless
// max_gap_m or max_missing_beams is set.
#include <cmath>

#include "algorithms/extract/parts/breakpoints.hpp"
#include "core/index.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

using namespace extract;

// Sums over the points of the current line, relative to its first point so that they do not cancel.
class TrackedLine {
 public:
  explicit TrackedLine(const Vec2& first) : origin_(first) {}

  void add(const Vec2& p) {
    const double x = p.x() - origin_.x();
    const double y = p.y() - origin_.y();
    n_ += 1.0;
    sx_ += x;
    sy_ += y;
    sxx_ += x * x;
    sxy_ += x * y;
    syy_ += y * y;
  }

  /// True if p is farther than t from the line, or from the centroid while the direction is undefined. The direction is
  /// not normalised, which saves two square roots and a division per point.
  bool farther(const Vec2& p, double t) const {
    // All second moments times n, all positions times n.
    const double sxx = n_ * sxx_ - sx_ * sx_;
    const double sxy = n_ * sxy_ - sx_ * sy_;
    const double syy = n_ * syy_ - sy_ * sy_;
    const double difference = sxx - syy;
    const double root = std::sqrt(difference * difference + 4.0 * sxy * sxy);
    const double dx = n_ * (p.x() - origin_.x()) - sx_;
    const double dy = n_ * (p.y() - origin_.y()) - sy_;
    const double tn = t * n_;
    if (!(root > 0)) return dx * dx + dy * dy > tn * tn;
    const bool flat = difference >= 0;  // selects the form of the eigenvector without cancellation
    const double ux = flat ? difference + root : 2.0 * sxy;
    const double uy = flat ? 2.0 * sxy : root - difference;
    const double across = ux * dy - uy * dx;
    return across * across > tn * tn * (ux * ux + uy * uy);
  }

 private:
  Vec2 origin_;
  double n_ = 0.0;
  double sx_ = 0.0, sy_ = 0.0;
  double sxx_ = 0.0, sxy_ = 0.0, syy_ = 0.0;
};

class LineTracking final : public LineExtractor {
 public:
  struct Params {
    double threshold_m = 0.10;
    Growth threshold = Growth::constant;
    double threshold_per_m = 0.01;
    Fit fit = Fit::tls;
    int min_points = 2;
    double min_length_m = 0.0;
    double max_gap_m = 0.0;
    int max_missing_beams = -1;

    static auto fields() {
      return std::tuple_cat(
          threshold_fields<Params>(
              "a line ends at the first point farther than this from the line through the points before it",
              "threshold_m, or threshold_m + threshold_per_m * r at the candidate's range r"),
          fit_field<Params>(), support_fields<Params>(), gap_fields<Params>());
    }
  };

  explicit LineTracking(const Params& params)
      : params_(params), threshold_(params.threshold_m, params.threshold, params.threshold_per_m) {}

  ScanLines extract(const Scan& scan, Trace& trace) const override {
    trace.stage(Stage::pre);
    const ScanPoints points = valid_points(scan);
    trace.stage(Stage::segment);
    std::vector<PointRun> runs;
    runs.reserve(32);
    for (const PointRun& whole : runs_between_gaps(points, {params_.max_gap_m, params_.max_missing_beams}))
      track(scan, points, whole, runs);
    const SupportRules rules{params_.min_points, params_.min_length_m};
    // The time of the least-squares line counts as grouping time, of which it is a part (Siadat, end of section 3).
    if (params_.fit == Fit::tls) {
      ScanLines lines = lines_of_runs(scan, points, runs, Fit::tls, rules);
      trace.stage(Stage::post);
      return lines;
    }
    trace.stage(Stage::post);
    return lines_of_runs(scan, points, runs, params_.fit, rules);
  }

 private:
  void track(const Scan& scan, const ScanPoints& points, const PointRun& whole, std::vector<PointRun>& runs) const {
    int i = whole.first;
    while (i <= whole.last) {
      const auto first = as_index(i);
      TrackedLine line(points.points[first]);
      line.add(points.points[first]);
      if (i < whole.last) line.add(points.points[first + 1]);
      int j = i + 2;
      for (; j <= whole.last; ++j) {
        const auto k = as_index(j);
        if (line.farther(points.points[k], threshold_.at(scan, points.beams[k]))) break;
        line.add(points.points[k]);
      }
      const int last = j <= whole.last ? j - 1 : whole.last;
      runs.push_back({i, last});
      i = last + 1;  // the rejected point and its successor seed the next line (Borges & Aldon 2000)
    }
  }

  Params params_;
  RangeThreshold threshold_;
};

SCANBENCH_REGISTER(LineExtractor, LineTracking,
                   {.name = "line_tracking",
                    .summary = "line tracking: extends a least-squares line until a point is too far from it",
                    .reference = "Siadat et al. 1997, section 4, fig. 5; Borges & Aldon 2000, section 2.1"});

}  // namespace
}  // namespace scanbench
