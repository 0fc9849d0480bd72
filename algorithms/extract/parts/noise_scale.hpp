// Tolerances from the sensor's data sheet, and the straightness test and the merging of neighbours of Nguyen et al., "A
// comparison of line extraction algorithms using 2D range data for indoor mobile robotics", Autonomous Robots 23, 2007.
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "algorithms/extract/parts/groups.hpp"

namespace scanbench::extract {

/// Largest distance of a return from its line: a multiple of the sensor's standard deviation at its range, but at least
/// `floor_m`, which is the tolerance for sensors without stated noise.
struct NoiseTolerance {
  double sigmas = 3.0;
  double floor_m = 0.01;
  double operator()(const Scan& scan, int beam) const;
};

/// The tolerance of every point.
std::vector<double> tolerances(const Scan& scan, const ScanPoints& points, const NoiseTolerance& tolerance);

/// True if two neighbours of the run are farther from the line than their tolerance, on the same side. Nguyen et al.
/// 2007, section on split-and-merge: one such point is noise, two consecutive ones are a break.
bool has_clear_break(std::span<const Vec2> points, std::span<const double> tolerance, const PointRun& run,
                     const LineFit& line);

/// Merges two neighbouring disjoint runs if the line through both has no clear break and their facing ends are at most
/// max_gap_m apart. Passes over the ordered runs are repeated until nothing changes.
std::vector<PointRun> merge_neighbours(std::span<const Vec2> points, std::span<const double> tolerance,
                                       std::span<const PointRun> runs, double max_gap_m);

/// The lines of disjoint runs. In a scan of a full turn the last and the first run are merged under the same condition.
ScanLines lines_of_disjoint_runs(const Scan& scan, const ScanPoints& points, std::span<const double> tolerance,
                                 std::span<const PointRun> runs, double max_gap_m, SupportRules rules);

/// Fields for Params with the members sigmas and floor_m.
template <class P>
auto noise_fields() {
  return std::tuple{
      field("sigmas", &P::sigmas, between(0.1, 100), "",
            "largest distance of a point from its line, in standard deviations of the sensor at its range"),
      field("floor_m", &P::floor_m, between(1e-6, 1e3), "m",
            "smallest value of that distance; it applies to sensors without stated noise")};
}

/// Field for Params with the member merge_gap_m.
template <class P>
auto merge_gap_field() {
  return std::tuple{field("merge_gap_m", &P::merge_gap_m, at_least(0), "m",
                          "largest gap between neighbouring collinear lines that are merged")};
}

}  // namespace scanbench::extract
