// sef: successive edge following. A line ends where two neighbouring returns are too far apart.
// Siadat et al. 1997, section 4 and fig. 4 (differences of ranges); Borges & Aldon 2000, section 2.1 (distances of
// points); Borges & Aldon 2004, section 3.1 (the adaptive threshold).
#include <cmath>

#include "algorithms/extract/parts/breakpoints.hpp"
#include "core/geometry/portable_math.hpp"
#include "core/index.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

using namespace extract;

double cotangent(double angle_rad) {
  const auto [sine, cosine] = portable::sincos(angle_rad);
  return cosine / sine;
}

enum class Variant { ranges, points };
enum class Threshold { constant, linear, incidence, adaptive };

class Sef final : public LineExtractor {
 public:
  struct Params {
    Variant variant = Variant::ranges;
    double threshold_m = 0.12;  // the best row of Siadat's tables 1 and 2
    Threshold threshold = Threshold::constant;
    double threshold_per_m = 0.01;
    double beta_min_rad = radians(10.0);
    double lambda_rad = radians(10.0);
    Fit fit = Fit::tls;
    int min_points = 2;
    double min_length_m = 0.0;
    double max_gap_m = 0.0;
    int max_missing_beams = -1;

    static auto fields() {
      return std::tuple_cat(
          std::tuple{
              choice("variant", &Params::variant, {{Variant::ranges, "ranges"}, {Variant::points, "points"}},
                     "what the threshold limits: the difference of neighbouring ranges (Siadat et al. 1997) or the "
                     "distance of neighbouring points (Borges & Aldon 2000)"),
              field("threshold_m", &Params::threshold_m, at_least(0), "m",
                    "largest difference or distance within a line; not used by the adaptive threshold"),
              choice(
                  "threshold", &Params::threshold,
                  {{Threshold::constant, "constant"},
                   {Threshold::linear, "linear"},
                   {Threshold::incidence, "incidence"},
                   {Threshold::adaptive, "adaptive"}},
                  "threshold at the smaller range r of two neighbours. constant: threshold_m; linear: threshold_m + "
                  "threshold_per_m * r; incidence: threshold_m + r * beam step * cot(beta_min_rad), which a plane at "
                  "a larger angle to the beam does not exceed; adaptive: the breakpoint detector of Borges & Aldon "
                  "2004"),
              field("threshold_per_m", &Params::threshold_per_m, at_least(0), "m/m",
                    "increase of the linear threshold with range"),
              field("beta_min_rad", &Params::beta_min_rad, between(0.001, 1.57), "rad",
                    "incidence threshold: smallest angle between beam and surface at which a noise-free plane is not "
                    "broken")},
          lambda_field<Params>(), fit_field<Params>(), support_fields<Params>(), gap_fields<Params>());
    }
  };

  explicit Sef(const Params& params)
      : params_(params), adaptive_(params.lambda_rad), cot_beta_min_(cotangent(params.beta_min_rad)) {}

  ScanLines extract(const Scan& scan, Trace& trace) const override {
    trace.stage(Stage::pre);
    const ScanPoints points = valid_points(scan);
    trace.stage(Stage::segment);
    const std::vector<PointRun> runs = group(scan, points);
    trace.stage(Stage::post);
    return lines_of_runs(scan, points, runs, params_.fit, {params_.min_points, params_.min_length_m});
  }

 private:
  std::vector<PointRun> group(const Scan& scan, const ScanPoints& points) const {
    std::vector<PointRun> runs;
    runs.reserve(64);
    for (const PointRun& whole : runs_between_gaps(points, {params_.max_gap_m, params_.max_missing_beams})) {
      if (params_.variant == Variant::ranges && params_.threshold == Threshold::constant) {
        const double t = params_.threshold_m;
        cut(scan, points, whole, runs, [t](std::size_t, double r, double r_next) { return std::fabs(r_next - r) > t; });
      } else {
        cut(scan, points, whole, runs,
            [&](std::size_t i, double r, double r_next) { return ends_after(scan, points, i, r, r_next); });
      }
    }
    return runs;
  }

  template <class EndsAfter>
  static void cut(const Scan& scan, const ScanPoints& points, const PointRun& whole, std::vector<PointRun>& runs,
                  EndsAfter&& ends_after) {
    const auto range = [&](int i) { return scan.ranges[as_index(points.beams[as_index(i)])]; };
    int first = whole.first;
    double r = range(first);
    for (int i = whole.first; i < whole.last; ++i) {
      const double r_next = range(i + 1);
      if (ends_after(as_index(i), r, r_next)) {
        runs.push_back({first, i});
        first = i + 1;
      }
      r = r_next;
    }
    runs.push_back({first, whole.last});
  }

  bool ends_after(const Scan& scan, const ScanPoints& points, std::size_t i, double r, double r_next) const {
    const double t = threshold(scan, points.beams[i], points.beams[i + 1], r < r_next ? r : r_next);
    if (params_.variant == Variant::ranges) return std::fabs(r_next - r) > t;
    return (points.points[i + 1] - points.points[i]).squaredNorm() > t * t;
  }

  double threshold(const Scan& scan, int beam, int next, double r) const {
    switch (params_.threshold) {
      case Threshold::constant:
        break;
      case Threshold::linear:
        return params_.threshold_m + params_.threshold_per_m * r;
      case Threshold::incidence:
        return params_.threshold_m + r * std::fabs(scan.sensor.geometry.angle_step()) * (next - beam) * cot_beta_min_;
      case Threshold::adaptive:
        return adaptive_.max_distance(scan, beam, next);
    }
    return params_.threshold_m;
  }

  Params params_;
  AdaptiveBreakpoint adaptive_;
  double cot_beta_min_ = 0.0;
};

SCANBENCH_REGISTER(LineExtractor, Sef,
                   {.name = "sef",
                    .summary = "successive edge following: breaks where neighbouring ranges jump",
                    .reference = "Siadat et al. 1997, section 4, fig. 4; the variant on points: "
                                 "Borges & Aldon 2000, section 2.1"});

}  // namespace
}  // namespace scanbench
