// kovesi: Kovesi's lineseg on the contours of a scan. It takes the longest straight piece from each break on. The end
// of a piece moves back to the point farthest from the chord until all points are near the chord. P. Kovesi, MATLAB and
// Octave functions for computer vision, lineseg and maxlinedev; used on scans by Lakaemper 2009, section V. Contours
// end at adaptive breakpoints (Borges & Aldon 2004). Each piece is refitted by total least squares.
#include "algorithms/extract/parts/breakpoints.hpp"
#include "algorithms/extract/parts/chord.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

using namespace extract;

class Kovesi final : public LineExtractor {
 public:
  struct Params {
    double tolerance_m = 0.05;
    double lambda_rad = radians(10.0);
    int min_points = 5;
    double min_length_m = 0.1;

    static auto fields() {
      return std::tuple_cat(std::tuple{field("tolerance_m", &Params::tolerance_m, at_least(0), "m",
                                             "largest distance of a point from the chord of its piece")},
                            lambda_field<Params>(), support_fields<Params>());
    }
  };

  explicit Kovesi(const Params& params) : params_(params), breakpoint_(params.lambda_rad) {}

  ScanLines extract(const Scan& scan, Trace& trace) const override {
    trace.stage(Stage::pre);
    const ScanPoints points = valid_points(scan);
    trace.stage(Stage::segment);
    std::vector<PointRun> runs;
    for (const PointRun& contour : runs_between_breakpoints(scan, points, breakpoint_)) {
      int first = contour.first;
      while (first < contour.last) {
        int last = contour.last;
        // This ends, because the farthest point is inside the piece and two points are always straight.
        while (last - first >= 2) {
          const Farthest far = farthest_from_chord(points.points, {first, last});
          if (!far.exceeds(params_.tolerance_m)) break;
          last = far.index;
        }
        runs.push_back({first, last});
        first = last;
      }
      if (contour.size() == 1) runs.push_back(contour);
    }
    trace.stage(Stage::post);
    return lines_of_runs(scan, points, runs, Fit::tls, {params_.min_points, params_.min_length_m});
  }

 private:
  Params params_;
  AdaptiveBreakpoint breakpoint_;
};

SCANBENCH_REGISTER(
    LineExtractor, Kovesi,
    {.name = "kovesi",
     .summary = "Kovesi's lineseg: the longest straight piece from each break, refitted by least squares",
     .reference = "P. Kovesi, lineseg and maxlinedev; as the segments of Lakaemper 2009, section V"});

}  // namespace
}  // namespace scanbench
