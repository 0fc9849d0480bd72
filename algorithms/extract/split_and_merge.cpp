// split_and_merge: contours between adaptive breakpoints are split until every piece is straight within the sensor's
// noise, then collinear neighbours are merged. Pavlidis & Horowitz 1974; Nguyen et al., Autonomous Robots 23, 2007, the
// algorithm "Split-and-Merge", with its rule that a break needs two neighbouring points off the line on the same side.
//
// The least-squares line decides whether a piece is straight, and the chord where to split it: at a corner the
// least-squares line is as far from the ends as from the vertex, but the chord is farthest from the vertex.
#include "algorithms/extract/parts/chord.hpp"
#include "algorithms/extract/parts/contour_extractor.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

using namespace extract;

class SplitAndMerge final : public ContourExtractor {
 public:
  using ContourExtractor::ContourExtractor;

 private:
  void cut(std::span<const Vec2> points, std::span<const double> tolerance, const PointRun& contour,
           std::vector<PointRun>& runs) const override {
    std::vector<PointRun> pending{contour};
    while (!pending.empty()) {
      const PointRun run = pending.back();
      pending.pop_back();
      if (straight(points, tolerance, run)) {
        runs.push_back(run);
        continue;
      }
      const int farthest = farthest_from_chord(points, run).index;
      pending.push_back({farthest + 1, run.last});
      pending.push_back({run.first, farthest});  // on top of the stack: runs are found in scan order
    }
  }

  static bool straight(std::span<const Vec2> points, std::span<const double> tolerance, const PointRun& run) {
    return run.size() < 3 || !has_clear_break(points, tolerance, run, fit_group(points_of(points, run), Fit::tls));
  }
};

SCANBENCH_REGISTER(
    LineExtractor, SplitAndMerge,
    {.name = "split_and_merge",
     .summary = "split-and-merge: splits contours until straight within the noise, merges collinear neighbours",
     .reference = "Pavlidis & Horowitz 1974; Nguyen et al. 2007, Autonomous Robots 23, algorithm Split-and-Merge"});

}  // namespace
}  // namespace scanbench
