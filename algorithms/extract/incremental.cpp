// incremental: adds a point to the current line if the line refitted with it is still straight within the noise of the
// sensor. Otherwise the point starts the next line. Nguyen et al., Autonomous Robots 23, 2007, the algorithm
// "Incremental". Collinear neighbours are merged, as in the paper.
//
// A line is straight if the new point is within `sigmas` standard deviations of the refitted line and, from 5 points
// on, the root mean square of the residuals is within half of that. Both tests take O(1) per point.
#include "algorithms/extract/parts/contour_extractor.hpp"
#include "core/index.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

using namespace extract;

class Incremental final : public ContourExtractor {
 public:
  using ContourExtractor::ContourExtractor;

 private:
  void cut(std::span<const Vec2> points, std::span<const double> tolerance, const PointRun& contour,
           std::vector<PointRun>& runs) const override {
    int first = contour.first;
    PointMoments line;
    for (int i = first; i <= contour.last; ++i) {
      const auto k = as_index(i);
      PointMoments with = line;
      with.add(points[k]);
      if (i - first >= 2 && !straight(fit_line(with), points[k], tolerance[k], i - first + 1)) {
        runs.push_back({first, i - 1});
        first = i;
        line = PointMoments();
        line.add(points[k]);
      } else {
        line = with;
      }
    }
    runs.push_back({first, contour.last});
  }

  static bool straight(const LineFit& line, const Vec2& newest, double tolerance, int count) {
    if (line.degenerate) return true;
    if (line.distance(newest) > tolerance) return false;
    return count < 5 || line.rms() <= 0.5 * tolerance;
  }
};

SCANBENCH_REGISTER(LineExtractor, Incremental,
                   {.name = "incremental",
                    .summary = "Incremental: extends a line while the refit with the next point stays straight",
                    .reference = "Nguyen et al. 2007, Autonomous Robots 23, algorithm Incremental"});

}  // namespace
}  // namespace scanbench
