// Division of a scan into runs at gaps and at adaptive breakpoints. Borges & Aldon 2004, section 3.1.
#include "algorithms/extract/parts/breakpoints.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/portable_math.hpp"
#include "core/index.hpp"

namespace scanbench::extract {
namespace {

template <class Breaks>
std::vector<PointRun> cut(const ScanPoints& points, Breaks&& breaks) {
  std::vector<PointRun> runs;
  const int n = static_cast<int>(points.size());
  int first = 0;
  for (int i = 1; i <= n; ++i) {
    if (i < n && !breaks(as_index(i - 1), as_index(i))) continue;
    runs.push_back({first, i - 1});
    first = i;
  }
  return runs;
}

}  // namespace

AdaptiveBreakpoint::AdaptiveBreakpoint(double lambda_rad)
    : sin_lambda_(portable::sincos(lambda_rad).sin), cos_lambda_(portable::sincos(lambda_rad).cos) {}

double AdaptiveBreakpoint::max_distance(const Scan& scan, int beam, int next_beam) const {
  if (next_beam - beam - 1 > kMostMissingBeams) return 0.0;
  const Vec2& u = scan.sensor.geometry.direction(beam);
  const Vec2& v = scan.sensor.geometry.direction(beam + 1);  // dphi is one step, also across missing beams
  const double sin_step = std::fabs(cross(u, v));
  const double cos_step = u.dot(v);
  const double sin_rest = sin_lambda_ * cos_step - cos_lambda_ * sin_step;  // sin(lambda - dphi)
  if (!(sin_rest > 0)) return 0.0;
  const double r = std::min(scan.ranges[as_index(beam)], scan.ranges[as_index(next_beam)]);
  return r * sin_step / sin_rest + 3.0 * scan.sensor.noise.range_sigma(r);
}

std::vector<PointRun> runs_between_gaps(const ScanPoints& points, const GapRules& rules) {
  if (points.size() == 0) return {};
  const bool by_distance = rules.max_gap_m > 0;
  const bool by_beams = rules.max_missing_beams >= 0;
  if (!by_distance && !by_beams) return {{0, static_cast<int>(points.size()) - 1}};
  const double limit2 = rules.max_gap_m * rules.max_gap_m;
  return cut(points, [&](std::size_t i, std::size_t j) {
    return (by_beams && points.beams[j] - points.beams[i] - 1 > rules.max_missing_beams) ||
           (by_distance && (points.points[j] - points.points[i]).squaredNorm() > limit2);
  });
}

std::vector<PointRun> runs_between_breakpoints(const Scan& scan, const ScanPoints& points,
                                               const AdaptiveBreakpoint& detector) {
  return cut(points, [&](std::size_t i, std::size_t j) {
    const double limit = detector.max_distance(scan, points.beams[i], points.beams[j]);
    return (points.points[j] - points.points[i]).squaredNorm() > limit * limit;
  });
}

}  // namespace scanbench::extract
