// Line fits of groups, and the labels of their supports. Siadat et al. 1997, eqs 3-6.
#include "algorithms/extract/parts/groups.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/geometry/portable_math.hpp"
#include "core/index.hpp"

namespace scanbench::extract {
namespace {

// Sets the sum of squared residuals of any line, not only the least-squares one.
void set_residual(const PointMoments& m, LineFit& fit) {
  const Vec2& n = fit.normal;
  const double off = n.dot(m.centroid()) - fit.offset;
  const double sum = n.x() * n.x() * m.sxx() + 2.0 * n.x() * n.y() * m.sxy() + n.y() * n.y() * m.syy();
  fit.residual_sum = std::max(0.0, sum) + m.weight() * off * off;
}

// The line through the centroid perpendicular to its ray; used for groups without a direction.
LineFit across_the_ray(const PointMoments& m) {
  LineFit fit;
  fit.centroid = m.centroid();
  fit.weight = m.weight();
  const double range = m.centroid().norm();
  if (range > 0) fit.normal = m.centroid() / range;
  fit.offset = range;
  set_residual(m, fit);
  return fit;
}

LineFit tls(const PointMoments& m) {
  const LineFit fit = fit_line(m);
  return fit.degenerate ? across_the_ray(m) : fit;
}

LineFit through_end_points(std::span<const Vec2> points, const PointMoments& m) {
  const Vec2 d = points.back() - points.front();
  const double length = d.norm();
  if (!(length > 0)) return tls(m);
  LineFit fit;
  fit.centroid = m.centroid();
  fit.weight = m.weight();
  fit.normal = perpendicular(d / length);
  fit.offset = fit.normal.dot(points.front());
  fit.degenerate = false;
  set_residual(m, fit);
  return fit;
}

LineFit siadat(std::span<const Vec2> points, const PointMoments& m) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;  // raw sums, origin at the sensor, as printed
  for (const Vec2& p : points) {
    sx += p.x();
    sy += p.y();
    sxx += p.x() * p.x();
    sxy += p.x() * p.y();
    syy += p.y() * p.y();
  }
  const double a = sx * syy - sy * sxy;    // eq. 4
  const double b = sy * sxx - sx * sxy;    // eq. 5
  const double c = sxy * sxy - sxx * syy;  // eq. 6, <= 0 by Cauchy and Schwarz; 0: all points on one ray
  const double scale = sxx + syy;
  const double norm = std::sqrt(a * a + b * b);
  if (!(-c > 1e-12 * scale * scale) || !(norm > 0)) return tls(m);
  LineFit fit;
  fit.centroid = m.centroid();
  fit.weight = m.weight();
  fit.normal = {a / norm, b / norm};
  fit.offset = -c / norm;
  fit.degenerate = false;
  set_residual(m, fit);
  return fit;
}

// LineFit::polar() without the wrapping that an angle from atan2 does not need.
PolarLine polar(const LineFit& fit) {
  const Vec2 n = fit.offset < 0 ? Vec2(-fit.normal) : fit.normal;
  const double alpha = portable::atan2(n.y(), n.x());
  if (fit.offset == 0 || alpha <= -kPi) return canonical(fit.offset < 0 ? -fit.offset : fit.offset, alpha);
  return {std::fabs(fit.offset), alpha};
}

LineFeature feature(const LineFit& fit, const Vec2& first, const Vec2& last) {
  LineFeature line;
  line.segment = {fit.project(first), fit.project(last)};
  // The ends are reversed in clockwise scans, and in short noisy groups on a line that nearly passes through the
  // sensor.
  if (cross(line.segment.a, line.segment.b) < 0) std::swap(line.segment.a, line.segment.b);
  line.line = polar(fit);
  line.rms_m = fit.rms();
  return line;
}

bool accepted(const LineFit& fit, const LineFeature& line, const SupportRules& rules) {
  if (line.points < rules.min_points) return false;
  if (fit.degenerate && rules.min_points > 1) return false;
  return !(rules.min_length_m > 0) || line.segment.length() >= rules.min_length_m;
}

template <class FitOfRun>
ScanLines assemble(const Scan& scan, const ScanPoints& points, std::span<const PointRun> runs, SupportRules rules,
                   FitOfRun&& fit_of_run) {
  ScanLines result;
  result.labels.assign(as_index(scan.beams()), -1);
  result.lines.reserve(runs.size());
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const PointRun& run = runs[k];
    // A shared break point is in the support of the next run.
    const int own_last = k + 1 < runs.size() ? std::min(run.last, runs[k + 1].first - 1) : run.last;
    const int own = own_last - run.first + 1;
    if (own < rules.min_points) continue;  // before the fit, which takes more time
    const LineFit fit = fit_of_run(k);
    LineFeature line = feature(fit, points.points[as_index(run.first)], points.points[as_index(run.last)]);
    line.first_beam = points.beams[as_index(run.first)];
    line.last_beam = points.beams[as_index(own_last)];
    line.points = own;
    if (!accepted(fit, line, rules)) continue;
    const int index = static_cast<int>(result.lines.size());
    for (int i = run.first; i <= own_last; ++i) result.labels[as_index(points.beams[as_index(i)])] = index;
    result.lines.push_back(line);
  }
  return result;
}

}  // namespace

PointMoments moments_of(std::span<const Vec2> points, std::span<const int> indices) {
  std::vector<Vec2> chosen;
  chosen.reserve(indices.size());
  for (const int i : indices) chosen.push_back(points[as_index(i)]);
  return PointMoments::of(chosen);
}

LineFit fit_group(std::span<const Vec2> points, Fit fit) {
  if (points.empty()) return {};
  const PointMoments m = PointMoments::of(points);
  switch (fit) {
    case Fit::end_points:
      return through_end_points(points, m);
    case Fit::siadat:
      return siadat(points, m);
    case Fit::tls:
      break;
  }
  return tls(m);
}

ScanLines lines_of_runs(const Scan& scan, const ScanPoints& points, std::span<const PointRun> runs, Fit fit,
                        SupportRules rules) {
  return assemble(scan, points, runs, rules,
                  [&](std::size_t k) { return fit_group(points_of(points.points, runs[k]), fit); });
}

ScanLines lines_of_runs(const Scan& scan, const ScanPoints& points, std::span<const PointRun> runs,
                        std::span<const LineFit> fits, SupportRules rules) {
  SCANBENCH_ASSERT(fits.size() == runs.size());
  return assemble(scan, points, runs, rules, [&](std::size_t k) { return fits[k]; });
}

ScanLines lines_of_groups(const Scan& scan, const ScanPoints& points, std::span<const int> group_of_point, int groups,
                          Fit fit, SupportRules rules) {
  SCANBENCH_ASSERT(group_of_point.size() == points.size());
  ScanLines result;
  result.labels.assign(as_index(scan.beams()), -1);

  // Members of each group in beam order, group after group.
  std::vector<std::size_t> begin(as_index(groups) + 1, 0);
  for (const int g : group_of_point)
    if (g >= 0) ++begin[as_index(g) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::size_t> members(begin.back());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  std::vector<int> order;  // groups by first member
  order.reserve(as_index(groups));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const int g = group_of_point[k];
    if (g < 0) continue;
    if (next[as_index(g)] == begin[as_index(g)]) order.push_back(g);
    members[next[as_index(g)]++] = k;
  }

  std::vector<Vec2> support;
  for (const int g : order) {
    const auto own = std::span(members).subspan(begin[as_index(g)], begin[as_index(g) + 1] - begin[as_index(g)]);
    support.clear();
    for (const std::size_t k : own) support.push_back(points.points[k]);
    const LineFit line_fit = fit_group(support, fit);
    const Vec2 along = perpendicular(line_fit.normal);
    const auto [low, high] = std::ranges::minmax_element(support, {}, [&](const Vec2& p) { return along.dot(p); });
    LineFeature line = feature(line_fit, *low, *high);
    line.first_beam = points.beams[own.front()];
    line.last_beam = points.beams[own.back()];
    line.points = static_cast<int>(own.size());
    if (!accepted(line_fit, line, rules)) continue;
    for (const std::size_t k : own) result.labels[as_index(points.beams[k])] = static_cast<int>(result.lines.size());
    result.lines.push_back(line);
  }
  return result;
}

}  // namespace scanbench::extract
