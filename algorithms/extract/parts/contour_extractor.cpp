// Steps of a contour extractor: contours, cutting, merging and fitting. Nguyen et al. 2007.
#include "algorithms/extract/parts/contour_extractor.hpp"

#include "algorithms/extract/parts/covariance.hpp"

namespace scanbench::extract {

ScanLines ContourExtractor::extract(const Scan& scan, Trace& trace) const {
  trace.stage(Stage::pre);
  const ScanPoints points = valid_points(scan);
  const std::vector<double> tolerance = tolerances(scan, points, {params_.sigmas, params_.floor_m});
  trace.stage(Stage::segment);
  std::vector<PointRun> runs;
  for (const PointRun& contour : runs_between_breakpoints(scan, points, breakpoint_))
    cut(points.points, tolerance, contour, runs);
  trace.stage(Stage::merge);
  runs = merge_neighbours(points.points, tolerance, runs, params_.merge_gap_m);
  trace.stage(Stage::post);
  ScanLines lines = lines_of_disjoint_runs(scan, points, tolerance, runs, params_.merge_gap_m,
                                           {params_.min_points, params_.min_length_m});
  if (tests_every_point()) add_covariances(scan, points, lines);
  return lines;
}

}  // namespace scanbench::extract
