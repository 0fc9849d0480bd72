// Division of a scan into runs at gaps and at adaptive breakpoints. Borges & Aldon 2004, section 3.1.
#include "algorithms/extract/parts/breakpoints.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/portable_math.hpp"
#include "core/index.hpp"

namespace scanbench::extract {
namespace {

// breaks(i - 1, i): is there a break between these points? none_in_four(i): is there none before points i .. i + 3?
template <class Breaks, class NoneInFour>
std::vector<PointRun> cut(const ScanPoints& points, Breaks&& breaks, NoneInFour&& none_in_four) {
  std::vector<PointRun> runs;
  const int n = static_cast<int>(points.size());
  int first = 0;
  for (int i = 1; i <= n; ++i) {
    while (i + 4 <= n && none_in_four(as_index(i))) i += 4;
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
  const Vec2* p = points.points.data();
  const auto breaks = [&](std::size_t i, std::size_t j) {
    return (by_beams && points.beams[j] - points.beams[i] - 1 > rules.max_missing_beams) ||
           (by_distance && (p[j] - p[i]).squaredNorm() > limit2);
  };
  const auto none_in_four = [&](std::size_t i) {
    if (by_beams) return false;
    const auto gap2 = [&](std::size_t k) { return (p[k] - p[k - 1]).squaredNorm(); };
    return std::max(std::max(gap2(i), gap2(i + 1)), std::max(gap2(i + 2), gap2(i + 3))) <= limit2;
  };
  return cut(points, breaks, none_in_four);
}

std::vector<PointRun> runs_between_breakpoints(const Scan& scan, const ScanPoints& points,
                                               const AdaptiveBreakpoint& detector) {
  const auto breaks = [&](std::size_t i, std::size_t j) {
    const double limit = detector.max_distance(scan, points.beams[i], points.beams[j]);
    return (points.points[j] - points.points[i]).squaredNorm() > limit * limit;
  };
  return cut(points, breaks, [](std::size_t) { return false; });
}

}  // namespace scanbench::extract
