// line_regression: fits a line to every window of neighbouring points. Where the lines of adjacent windows agree within
// their uncertainty, the points are on one line. Arras & Siegwart 1997, "Feature extraction and scene interpretation
// for map-based navigation and map building", section 2; Nguyen et al., Autonomous Robots 23, 2007, the algorithm
// "Line-Regression". Collinear neighbours are merged.
#include <tuple>

#include "algorithms/extract/parts/contour_extractor.hpp"
#include "core/geometry/portable_math.hpp"
#include "core/index.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

using namespace extract;

class LineRegression final : public ContourExtractor {
 public:
  struct Params {
    int window = 9;
    double fidelity = 9.0;
    double sigmas = 3.0;
    double floor_m = 0.01;
    double lambda_rad = radians(10.0);
    double merge_gap_m = 0.3;
    int min_points = 5;
    double min_length_m = 0.1;

    static auto fields() {
      return std::tuple_cat(
          std::tuple{
              field("window", &Params::window, between(3, 101), "",
                    "number of points of the sliding window; an even number counts as the next odd one"),
              field("fidelity", &Params::fidelity, above(0), "",
                    "largest squared Mahalanobis distance (two degrees of freedom) between the lines of the half "
                    "windows before and after a point")},
          contour_fields<Params>());
    }
  };

  explicit LineRegression(const Params& p)
      : ContourExtractor({p.sigmas, p.floor_m, p.lambda_rad, p.merge_gap_m, p.min_points, p.min_length_m}),
        window_(p.window),
        fidelity_(p.fidelity),
        sigmas_(p.sigmas) {}

 private:
  // Squared Mahalanobis distance of the lines of two windows, in (offset at the point between them, angle). For n
  // points with noise s, the offset of the line at the centroid has the variance s^2 / n and its angle has the variance
  // s^2 / (sum of squares along the line). The two are uncorrelated at the centroid. The errors of the two windows are
  // treated as independent.
  static double disagreement(const LineFit& left, const PointMoments& a, const LineFit& right, const PointMoments& b,
                             const Vec2& between, double sigma) {
    Vec2 n = right.normal;
    if (left.normal.dot(n) < 0) n = -n;
    const double angle = portable::atan2(cross(left.normal, n), left.normal.dot(n));
    const double offset = left.normal.dot(between - left.centroid) - n.dot(between - right.centroid);
    double c00 = 0, c01 = 0, c11 = 0;
    for (const auto& [line, moments, normal] : {std::tuple{&left, &a, left.normal}, std::tuple{&right, &b, n}}) {
      const Vec2 along = perpendicular(normal);
      const double spread = moments->sxx() + moments->syy() - line->residual_sum;
      const double t = along.dot(between - line->centroid);
      const double var_angle = sigma * sigma / spread;
      c00 += sigma * sigma / line->weight + t * t * var_angle;
      c01 -= t * var_angle;  // rotating a line by e moves its offset by t e; angle is right minus left
      c11 += var_angle;
    }
    const double det = c00 * c11 - c01 * c01;
    return det > 0 ? (c11 * offset * offset - 2 * c01 * offset * angle + c00 * angle * angle) / det : 0.0;
  }

  void cut(std::span<const Vec2> points, std::span<const double> tolerance, const PointRun& contour,
           std::vector<PointRun>& runs) const override {
    const int half = window_ / 2 + 1;  // number of points of half a window; the middle point is in both halves
    const auto window = [&](int first) { return points.subspan(as_index(first), as_index(half)); };
    // A corner is a sequence of windows whose disagreement is above the threshold. The contour is cut at its peak.
    int first = contour.first;
    int peak = -1;
    double highest = fidelity_;
    for (int i = contour.first + half - 1; i + half - 1 <= contour.last; ++i) {
      const PointMoments a = PointMoments::of(window(i - half + 1));
      const PointMoments b = PointMoments::of(window(i));
      const LineFit left = fit_line(a), right = fit_line(b);
      const auto k = as_index(i);
      const double sigma = tolerance[k] / sigmas_;
      const double d = left.degenerate || right.degenerate ? 0.0 : disagreement(left, a, right, b, points[k], sigma);
      if (d > highest) {
        highest = d;
        peak = i;
      }
      if (peak >= 0 && (d <= fidelity_ || i - peak >= half)) {
        runs.push_back({first, peak - 1});
        first = peak;
        peak = -1;
        highest = fidelity_;
      }
    }
    if (peak > first) {
      runs.push_back({first, peak - 1});
      first = peak;
    }
    runs.push_back({first, contour.last});
  }

  bool tests_every_point() const override { return false; }  // windows are tested against each other

  int window_;
  double fidelity_;
  double sigmas_;
};

SCANBENCH_REGISTER(
    LineExtractor, LineRegression,
    {.name = "line_regression",
     .summary = "line regression: breaks where the lines of adjacent windows disagree beyond their uncertainty",
     .reference = "Arras & Siegwart 1997, section 2; Nguyen et al. 2007, Autonomous Robots 23, algorithm "
                  "Line-Regression"});

}  // namespace
}  // namespace scanbench
