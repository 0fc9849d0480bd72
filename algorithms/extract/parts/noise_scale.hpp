// Tolerances that follow from the sensor's data sheet, and the straightness test and merging of neighbours that the
// algorithms of Nguyen et al., "A comparison of line extraction algorithms using 2D range data for indoor mobile
// robotics", Autonomous Robots 23, 2007, share.
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "algorithms/extract/parts/groups.hpp"

namespace scanbench::extract {

/// Largest distance of a return from the line it belongs to: a number of the sensor's standard deviations at its range,
/// but never below a floor, which also serves sensors without a stated noise.
struct NoiseTolerance {
  double sigmas = 3.0;
  double floor_m = 0.01;
  double operator()(const Scan& scan, int beam) const;
};

/// The tolerance of every point; computed once, used by every test.
std::vector<double> tolerances(const Scan& scan, const ScanPoints& points, const NoiseTolerance& tolerance);

/// Whether two neighbours of the run lie beyond their tolerance on the same side of the line. Nguyen et al. 2007,
/// section on split-and-merge: a single such point is noise, two in a row are a break.
bool has_clear_break(std::span<const Vec2> points, std::span<const double> tolerance, const PointRun& run,
                     const LineFit& line);

/// Neighbouring disjoint runs, in order, become one where the line through both has no clear break and their facing
/// ends are at most max_gap_m apart. In passes from the first to the last, until nothing changes.
std::vector<PointRun> merge_neighbours(std::span<const Vec2> points, std::span<const double> tolerance,
                                       std::span<const PointRun> runs, double max_gap_m);

/// The lines of disjoint runs. On a scan of a full turn the last and the first become one under the same test.
ScanLines lines_of_disjoint_runs(const Scan& scan, const ScanPoints& points, std::span<const double> tolerance,
                                 std::span<const PointRun> runs, double max_gap_m, SupportRules rules);

/// Fields for Params with the members sigmas and floor_m.
template <class P>
auto noise_fields() {
  return std::tuple{field("sigmas", &P::sigmas, between(0.1, 100), "",
                          "largest distance of a point from its line, in standard deviations of the sensor there"),
                    field("floor_m", &P::floor_m, between(1e-6, 1e3), "m",
                          "but at least this, for sensors whose noise is not stated")};
}

/// Field for Params with the member merge_gap_m.
template <class P>
auto merge_gap_field() {
  return std::tuple{field("merge_gap_m", &P::merge_gap_m, at_least(0), "m",
                          "neighbouring collinear lines become one if their facing ends are no farther apart")};
}

}  // namespace scanbench::extract
