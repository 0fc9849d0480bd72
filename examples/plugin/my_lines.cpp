// my_lines: one line through all returns.
#include "core/geometry/least_squares.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

class MyLines final : public LineExtractor {
 public:
  struct Params {
    int min_points = 2;
    static auto fields() {
      return std::tuple{field("min_points", &Params::min_points, at_least(2), "", "fewest returns that make a line")};
    }
  };
  explicit MyLines(Params params) : params_(params) {}

  ScanLines extract(const Scan& scan, Trace& trace) const override {
    trace.stage(Stage::segment);
    ScanLines found{{}, std::vector<int>(static_cast<std::size_t>(scan.beams()), -1)};
    const ScanPoints points = valid_points(scan);
    if (static_cast<int>(points.size()) < params_.min_points) return found;
    const LineFit fit = fit_line(points.points);
    if (fit.degenerate) return found;  // all returns at one point
    LineFeature line;
    line.segment = seen_from_origin(fit.project(points.points.front()), fit.project(points.points.back()));
    line.line = fit.polar();
    line.first_beam = points.beams.front();
    line.last_beam = points.beams.back();
    line.points = static_cast<int>(points.size());
    line.rms_m = fit.rms();
    for (const int beam : points.beams) found.labels[static_cast<std::size_t>(beam)] = 0;
    found.lines.push_back(line);
    return found;
  }

 private:
  Params params_;
};

SCANBENCH_REGISTER(LineExtractor, MyLines,
                   {.name = "my_lines", .summary = "one line through all returns", .reference = "none"});

}  // namespace
}  // namespace scanbench
