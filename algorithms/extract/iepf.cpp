// iepf: iterative end point fit. A run of points is split at the point farthest from its chord until all points are
// near their chords. Siadat et al. 1997, section 4 and fig. 6; Borges & Aldon 2000, section 2.2.
//
// Both halves contain the break point (p' and p'' of Borges & Aldon): both chords and both fitted lines use it. It is
// in the support of the second half only, so that supports partition the points.
//
// In the papers a line may bridge any gap, and two points make a line (max_gap_m: 0, min_points: 2). On recorded scans
// that draws fans of lines through free space, so the defaults are stricter.
#include "algorithms/extract/parts/breakpoints.hpp"
#include "algorithms/extract/parts/chord.hpp"
#include "core/index.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

using namespace extract;

class Iepf final : public LineExtractor {
 public:
  struct Params {
    double threshold_m = 0.10;
    Growth threshold = Growth::constant;
    double threshold_per_m = 0.01;
    Fit fit = Fit::tls;  // both papers refit by least squares after the grouping
    bool share_breaks = true;
    int min_points = 5;
    double min_length_m = 0.0;
    double max_gap_m = 0.5;
    int max_missing_beams = -1;

    static auto fields() {
      return std::tuple_cat(
          threshold_fields<Params>(
              "largest distance of a point from the chord of its line",
              "threshold_m, or threshold_m + threshold_per_m * r at the range r of the farthest point"),
          std::tuple{
              field("share_breaks", &Params::share_breaks,
                    "fit both lines at a break point to it; it is in the support of the second line in either case")},
          fit_field<Params>(), support_fields<Params>(), gap_fields<Params>());
    }
  };

  explicit Iepf(const Params& params)
      : params_(params), threshold_(params.threshold_m, params.threshold, params.threshold_per_m) {}

  ScanLines extract(const Scan& scan, Trace& trace) const override {
    trace.stage(Stage::pre);
    const ScanPoints points = valid_points(scan);
    trace.stage(Stage::segment);
    std::vector<PointRun> runs;
    runs.reserve(64);
    std::vector<PointRun> pending;
    pending.reserve(64);
    for (const PointRun& whole : runs_between_gaps(points, {params_.max_gap_m, params_.max_missing_beams}))
      split(scan, points, whole, pending, runs);
    trace.stage(Stage::post);
    return lines_of_runs(scan, points, runs, params_.fit, {params_.min_points, params_.min_length_m});
  }

 private:
  void split(const Scan& scan, const ScanPoints& points, const PointRun& whole, std::vector<PointRun>& pending,
             std::vector<PointRun>& runs) const {
    pending.assign(1, whole);
    while (!pending.empty()) {
      const PointRun run = pending.back();
      pending.pop_back();
      if (run.last - run.first >= 2) {
        const Farthest far = farthest_from_chord(points.points, run);
        if (far.exceeds(threshold_.at(scan, points.beams[as_index(far.index)]))) {
          pending.push_back({far.index, run.last});
          pending.push_back({run.first, far.index});  // on top of the stack: lines are found in scan order
          continue;
        }
      }
      runs.push_back(run);
      if (!params_.share_breaks && run.last < whole.last) --runs.back().last;
    }
  }

  Params params_;
  RangeThreshold threshold_;
};

SCANBENCH_REGISTER(LineExtractor, Iepf,
                   {.name = "iepf",
                    .summary = "iterative end point fit: splits at the point farthest from the chord",
                    .reference = "Siadat et al. 1997, section 4, fig. 6; Borges & Aldon 2000, section 2.2"});

}  // namespace
}  // namespace scanbench
