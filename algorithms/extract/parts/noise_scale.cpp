// Straightness test within the noise of the sensor, and merging of runs. Nguyen et al. 2007.
#include "algorithms/extract/parts/noise_scale.hpp"

#include <algorithm>
#include <cmath>

#include "core/index.hpp"

namespace scanbench::extract {
namespace {

bool full_turn(const ScanGeometry& g) {
  return g.beams() > 2 && std::fabs(g.angle_step()) * (g.beams() + 0.5) >= kTwoPi;
}

}  // namespace

double NoiseTolerance::operator()(const Scan& scan, int beam) const {
  return std::max(floor_m, sigmas * scan.sensor.noise.range_sigma(scan.ranges[as_index(beam)]));
}

std::vector<double> tolerances(const Scan& scan, const ScanPoints& points, const NoiseTolerance& tolerance) {
  std::vector<double> result;
  result.reserve(points.size());
  for (const int beam : points.beams) result.push_back(tolerance(scan, beam));
  return result;
}

bool has_clear_break(std::span<const Vec2> points, std::span<const double> tolerance, const PointRun& run,
                     const LineFit& line) {
  int side_before = 0;
  for (int i = run.first; i <= run.last; ++i) {
    const Vec2& p = points[as_index(i)];
    const double d = line.normal.x() * p.x() + line.normal.y() * p.y() - line.offset;
    const int side = d > tolerance[as_index(i)] ? 1 : d < -tolerance[as_index(i)] ? -1 : 0;
    if (side != 0 && side == side_before) return true;
    side_before = side;
  }
  return false;
}

std::vector<PointRun> merge_neighbours(std::span<const Vec2> points, std::span<const double> tolerance,
                                       std::span<const PointRun> runs, double max_gap_m) {
  // Each pass merges pairs in time linear in the points. A wall in many pieces needs a logarithmic number of passes.
  std::vector<PointRun> current(runs.begin(), runs.end());
  while (true) {
    std::vector<PointRun> merged;
    for (std::size_t k = 0; k < current.size(); ++k) {
      merged.push_back(current[k]);
      if (k + 1 == current.size()) break;
      const PointRun both{current[k].first, current[k + 1].last};
      const double gap = (points[as_index(current[k + 1].first)] - points[as_index(current[k].last)]).norm();
      if (gap > max_gap_m || has_clear_break(points, tolerance, both, fit_group(points_of(points, both), Fit::tls)))
        continue;
      merged.back() = both;
      ++k;
    }
    if (merged.size() == current.size()) return merged;
    current = std::move(merged);
  }
}

ScanLines lines_of_disjoint_runs(const Scan& scan, const ScanPoints& points, std::span<const double> tolerance,
                                 std::span<const PointRun> runs, double max_gap_m, SupportRules rules) {
  std::vector<int> group(points.size(), -1);
  for (std::size_t k = 0; k < runs.size(); ++k)
    for (int i = runs[k].first; i <= runs[k].last; ++i) group[as_index(i)] = static_cast<int>(k);

  if (runs.size() > 1 && full_turn(scan.sensor.geometry)) {
    const PointRun& head = runs.front();
    const PointRun& tail = runs.back();
    PointMoments both = PointMoments::of(points_of(points.points, tail));
    both.add(PointMoments::of(points_of(points.points, head)));
    const LineFit line = fit_line(both);
    const double gap = (points.points[as_index(head.first)] - points.points[as_index(tail.last)]).norm();
    if (!line.degenerate && gap <= max_gap_m && !has_clear_break(points.points, tolerance, head, line) &&
        !has_clear_break(points.points, tolerance, tail, line))
      for (int i = tail.first; i <= tail.last; ++i) group[as_index(i)] = 0;
  }
  return lines_of_groups(scan, points, group, static_cast<int>(runs.size()), Fit::tls, rules);
}

}  // namespace scanbench::extract
