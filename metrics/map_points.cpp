// map_points: the distances of the scan points from the scans' own lines and from the merged map, and how much smaller
// the map is (Lakaemper, "Simultaneous multi-line-segment merging for robot mapping using mean shift clustering", IROS
// 2009, section V.A). Needs no truth.
//
// D_S and D_M are means over the same points: those within mean + 2 standard deviations of the distance to the scans'
// lines.
#include <cmath>
#include <set>

#include "core/error.hpp"
#include "core/geometry/segment_grid.hpp"
#include "core/registry.hpp"
#include "metrics/rows.hpp"

namespace scanbench::metrics {
namespace {

constexpr double kBytes = 8.0;  // of a number: ranges, poses and end points have 64 bits each

class MapPoints : public MetricFamily {
 public:
  struct Params {
    double inlier_sigmas = 2.0;
    static auto fields() {
      return std::tuple{field("inlier_sigmas", &Params::inlier_sigmas, above(0), "",
                              "points farther away than the mean plus this many standard deviations are excluded")};
    }
  };

  explicit MapPoints(const Params& params) : params_(params) {}

  std::vector<MetricDescription> describe() const override {
    using enum Direction;
    // A small map is not better: one that merges different walls or misses some is smaller than the right one, and the
    // right number of lines is not known without truth (lines_per_wall of map_truth compares with it).
    return {{"D_S", "distance to scan lines", "m", neither, 0.0005,
             "mean distance of inlying scan points to the nearest line of any scan"},
            {"D_M", "distance to map lines", "m", lower_is_better, 0.0005,
             "mean distance of inlying scan points to the nearest line of the map"},
            share({"inliers", "inlying points", "", neither, 0.005,
                   "share of the scan points that D_S and D_M average: those near a line of the scans"}),
            {"compression", "compression", "", neither, 0.5,
             "numbers in the scan points (2 each) per number in the map (4 per line)"},
            {"compression_bytes", "compression in bytes", "", neither, 0.5,
             "bytes of the ranges and poses as recorded per byte of the map's end points"},
            {"scan_points", "scan points", "", neither, 0.0, "valid scan points"},
            {"scan_lines", "scan lines", "", neither, 0.0, "lines of all scans"},
            {"clusters1", "clusters, phase 1", "", neither, 0.0,
             "clusters of the first phase that contain the largest part of some line"},
            {"clusters2", "clusters, phase 2", "", neither, 0.0,
             "clusters of the second phase that contain the largest part of some line"},
            {"map_lines", "map lines", "", neither, 0.5, "lines of the map"}};
  }

  bool applies(const MetricInput& input) const override {
    const std::size_t frames = input.observed.frames.size();
    return frames > 0 && input.result.world_from_sensor.size() == frames && input.result.lines.size() == frames;
  }

  std::vector<MetricRow> evaluate(const MetricInput& input) const override {
    const std::vector<Pose2>& poses = input.result.world_from_sensor;
    SCANBENCH_ASSERT(poses.size() == input.observed.frames.size() && poses.size() == input.result.lines.size());
    std::vector<Vec2> points;
    std::vector<Segment> scan_lines, map_lines;
    for (std::size_t f = 0; f < poses.size(); ++f) {
      for (const Vec2& p : valid_points(input.observed.scan(f)).points) points.push_back(poses[f] * p);
      for (const LineFeature& line : input.result.lines[f].lines) scan_lines.push_back(poses[f] * line.segment);
    }
    for (const MapLine& line : input.result.map.lines) map_lines.push_back(line.segment);
    const SegmentGrid scans(scan_lines);
    const SegmentGrid map(map_lines);

    Mean to_scans, to_map;
    if (!scans.empty()) {
      std::vector<double> distances;
      Mean mean, squared_deviation;
      for (const Vec2& p : points) {
        distances.push_back(scans.distance(p));
        mean.add(distances.back());
      }
      for (const double d : distances) squared_deviation.add((d - mean.value()) * (d - mean.value()));
      const double limit = mean.value() + params_.inlier_sigmas * squared_deviation.root();
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (!(distances[i] <= limit)) continue;
        to_scans.add(distances[i]);
        if (!map.empty()) to_map.add(map.distance(points[i]));
      }
    }

    const auto n_points = std::ssize(points);
    const double recorded = number(poses.size()) * (input.observed.sensor.geometry.beams() + 3.0) * kBytes;
    const double stored = 4.0 * number(map_lines.size()) * kBytes;
    Rows rows(describe());
    rows.add("D_S", kAll, to_scans);
    rows.add("D_M", kAll, to_map);
    rows.add("inliers", kAll, to_scans.count() > 0 ? ratio(number(to_scans.count()), number(n_points)) : kUndefined,
             n_points);
    const bool scanned = n_points > 0;  // lines without points cannot be compressed
    rows.add("compression", kAll, scanned ? ratio(2.0 * number(n_points), 4.0 * number(map_lines.size())) : kUndefined,
             std::ssize(map_lines));
    rows.add("compression_bytes", kAll, scanned ? ratio(recorded, stored) : kUndefined, std::ssize(map_lines));
    rows.add("scan_points", kAll, number(n_points), std::ssize(poses));
    rows.add("scan_lines", kAll, number(scan_lines.size()), std::ssize(poses));
    rows.add("clusters1", kAll, clusters(input.result, &MergeLabel::cluster1), std::ssize(scan_lines));
    rows.add("clusters2", kAll, clusters(input.result, &MergeLabel::cluster2), std::ssize(scan_lines));
    rows.add("map_lines", kAll, number(map_lines.size()), std::ssize(poses));
    return rows.take();
  }

 private:
  /// The number of clusters of a phase; undefined for a merger without that phase.
  static double clusters(const PipelineResult& result, int MergeLabel::*cluster) {
    std::set<int> labels;
    for (const MergeLabel& label : result.merge_labels) labels.insert(label.*cluster);
    labels.erase(-1);
    return labels.empty() ? kUndefined : number(labels.size());
  }

  Params params_;
};

SCANBENCH_REGISTER(
    MetricFamily, MapPoints,
    {.name = "map_points",
     .summary = "distance of the scan points to the scans' lines and to the map, compression; needs no truth",
     .reference = "Lakaemper 2009, section V.A"});

}  // namespace
}  // namespace scanbench::metrics
