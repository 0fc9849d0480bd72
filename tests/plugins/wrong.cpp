// Five line extractors, each with one fault that the conformance checks must find.
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/geometry/least_squares.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

/// One line through all returns: without fault.
ScanLines one_line(const Scan& scan) {
  ScanLines found{{}, std::vector<int>(scan.ranges.size(), -1)};
  const ScanPoints points = valid_points(scan);
  if (points.size() < 2) return found;
  const LineFit fit = fit_line(points.points);
  if (fit.degenerate) return found;
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

enum class Fault { remembers, reverses, counts, few_beams, empty };

template <Fault kFault>
class Wrong final : public LineExtractor {
 public:
  using Params = NoParams;
  explicit Wrong(Params) {}

  ScanLines extract(const Scan& scan, Trace&) const override {
    if (kFault == Fault::few_beams && scan.beams() > 10000) throw std::runtime_error("too many beams for my table");
    if (kFault == Fault::empty && valid_points(scan).size() == 0) throw std::runtime_error("no points");
    ScanLines found = one_line(scan);
    for (LineFeature& line : found.lines) {
      if (kFault == Fault::reverses && scan.sensor.geometry.angle_step() < 0) std::swap(line.segment.a, line.segment.b);
      if (kFault == Fault::counts) line.points += 1;
      if (kFault == Fault::remembers) line.rms_m += 1e-9 * ++calls_;
    }
    return found;
  }

 private:
  mutable int calls_ = 0;
};

template <Fault kFault>
bool add(const std::string& name) {
  return Registry<LineExtractor>::add<Wrong<kFault>>(
      {.name = name, .summary = "a module with one fault", .reference = "none"});
}

const bool registered = add<Fault::remembers>("remembers") && add<Fault::reverses>("reverses") &&
                        add<Fault::counts>("counts") && add<Fault::few_beams>("few_beams") &&
                        add<Fault::empty>("empty");

}  // namespace
}  // namespace scanbench
