// Split-and-merge: contours between adaptive breakpoints are split until every piece is straight within the sensor's
// noise, then collinear neighbours are merged. Pavlidis & Horowitz 1974; Nguyen et al., Autonomous Robots 23, 2007,
// the algorithm "Split-and-Merge", with its rule that a break needs two neighbouring points off the same side.
//
// Whether a piece is straight is asked of its least-squares line, where to cut it of its chord: at a corner the
// least-squares line is as far from the ends as from the vertex, the chord is not.
#include <algorithm>

#include "algorithms/extract/breakpoints.hpp"
#include "algorithms/extract/chord.hpp"
#include "algorithms/extract/noise_scale.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

using namespace extract;

class SplitAndMerge final : public LineExtractor {
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

  explicit SplitAndMerge(const Params& params) : params_(params), breakpoint_(params.lambda_rad) {}

  ScanLines extract(const Scan& scan, Trace& trace) const override {
    trace.stage("pre");
    const ScanPoints points = valid_points(scan);
    const std::vector<double> tolerance = tolerances(scan, points, {params_.sigmas, params_.floor_m});
    trace.stage("segment");
    std::vector<PointRun> pending = runs_between_breakpoints(scan, points, breakpoint_);
    std::reverse(pending.begin(), pending.end());  // a stack, the first contour on top
    std::vector<PointRun> runs;
    while (!pending.empty()) {
      const PointRun run = pending.back();
      pending.pop_back();
      if (straight(points, tolerance, run)) {
        runs.push_back(run);
        continue;
      }
      const int cut = farthest_from_chord(points.points, run).index;
      pending.push_back({cut + 1, run.last});
      pending.push_back({run.first, cut});
    }
    trace.stage("merge");
    runs = merge_neighbours(points.points, tolerance, runs, params_.merge_gap_m);
    trace.stage("post");
    return lines_of_disjoint_runs(scan, points, tolerance, runs, params_.merge_gap_m,
                                  {params_.min_points, params_.min_length_m});
  }

 private:
  bool straight(const ScanPoints& points, std::span<const double> tolerance, const PointRun& run) const {
    if (run.size() < 3) return true;
    const auto own =
        std::span(points.points).subspan(static_cast<std::size_t>(run.first), static_cast<std::size_t>(run.size()));
    return !has_clear_break(points.points, tolerance, run, fit_group(own, Fit::tls));
  }

  Params params_;
  AdaptiveBreakpoint breakpoint_;
};

const bool registered = Registry<LineExtractor>::add<SplitAndMerge>(
    {.name = "split_and_merge",
     .summary = "Split-and-merge: splits contours until straight within the noise, merges collinear neighbours",
     .reference = "Pavlidis & Horowitz 1974; Nguyen et al. 2007, Autonomous Robots 23, algorithm Split-and-Merge"});

}  // namespace
}  // namespace scanbench
