// siadat1997: number of segments, residuals and times (Siadat, Kaske, Klausmann, Dufaut & Husson, "An optimized
// segmentation method for a 2D laser-scanner applied to mobile robot navigation", SICICA 1997, tables 1-3).
//
// The paper's "geometric average" and "average of the maximal error of every single scan" do not define the averaging.
// d_mean and d_max average over the segments of a scan and then over the scans: no other order fits the ratios of the
// printed tables. d_mean_pts and d_max_scan follow the words literally. polygon_bytes and compression are about the
// size of the representation of section 6 (core/geometry/polygon.hpp), 48 bytes per segment in the paper.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/error.hpp"
#include "core/geometry/polygon.hpp"
#include "core/index.hpp"
#include "core/registry.hpp"
#include "core/special_values.hpp"
#include "metrics/rows.hpp"

namespace scanbench::metrics {
namespace {

constexpr double kRangeBytes = 4.0;  // the width of a field of the polygon

/// Sum and maximum of the distances of a group's points from its line.
struct GroupResidual {
  int points = 0;
  double sum = 0.0;
  double max = 0.0;
};

std::vector<GroupResidual> group_residuals(const Scan& scan, const ScanLines& found) {
  SCANBENCH_ASSERT(found.labels.size() == as_index(scan.beams()));
  std::vector<Vec2> normals;
  for (const LineFeature& line : found.lines) normals.push_back(line.line.normal());
  std::vector<GroupResidual> groups(found.lines.size());
  for (int i = 0; i < scan.beams(); ++i) {
    const int label = found.labels[as_index(i)];
    if (label < 0 || !scan.valid(i)) continue;
    const auto k = as_index(label);
    const double d = std::fabs(normals[k].dot(scan.point(i)) - found.lines[k].line.rho);
    ++groups[k].points;
    groups[k].sum += d;
    groups[k].max = std::max(groups[k].max, d);
  }
  // One or two points determine their line and have no residual, even if the extractor's line misses them.
  for (GroupResidual& g : groups)
    if (g.points <= 2) g.sum = g.max = 0.0;
  return groups;
}

/// The three parts into which the paper divides the time. Extractors name their stages more finely; each stage is in
/// one part, so that the three add up to the time of the extractor.
enum class TimePart { before, segmentation, after };

TimePart part_of(const std::optional<Stage>& stage) {
  if (stage == Stage::pre) return TimePart::before;
  if (!stage || stage == Stage::segment || stage == Stage::search) return TimePart::segmentation;
  return TimePart::after;  // fits, merges, and what is dropped
}

/// Mean over the frames of the CPU time spent in a part, or in all of them, in ms. A run that was timed but never
/// entered a part spent 0 there (LT has no fit after its grouping); one that was not timed has no rows at all.
Mean time_of(const std::vector<StageTime>& times, std::optional<TimePart> part) {
  std::map<int, double> per_frame;
  for (const StageTime& t : times)
    if (t.frame >= 0 && t.of_extraction()) per_frame[t.frame] += !part || part_of(t.stage) == *part ? t.seconds : 0.0;
  Mean mean;
  for (const auto& [frame, seconds] : per_frame) mean.add(1e3 * seconds);
  return mean;
}

class Siadat1997 : public MetricFamily {
 public:
  using Params = NoParams;
  explicit Siadat1997(const Params&) {}

  std::vector<MetricDescription> describe() const override {
    using enum Direction;
    // Fewer segments are not better: an extractor that finds one line per scan has the fewest and the smallest polygon.
    return {
        {"s_min", "fewest segments of a scan", "", neither, 0.5, "fewest segments of a scan; single points count"},
        {"s_mean", "segments per scan", "", neither, 0.5, "segments per scan"},
        {"s_max", "most segments of a scan", "", neither, 0.5, "most segments of a scan"},
        {"d_mean", "point distance, by segment", "m", lower_is_better, 0.001,
         "mean distance of points from their segment's line, averaged over a segment, a scan's segments, the scans"},
        {"d_max", "largest point distance, by segment", "m", lower_is_better, 0.002,
         "largest distance of a point from its segment's line, averaged over a scan's segments, the scans"},
        {"d_mean_pts", "point distance, by point", "m", lower_is_better, 0.001,
         "mean distance of points from their segment's line, averaged over all points of a scan, the scans"},
        {"d_max_scan", "largest point distance, by scan", "m", lower_is_better, 0.005,
         "largest distance in a scan, mean over the scans"},
        {"t_pre", "time before segmentation", "ms", lower_is_better, 0.0, "CPU time per scan before segmentation",
         true},
        {"t_seg", "segmentation time", "ms", lower_is_better, 0.0,
         "CPU time per scan of segmentation, searches included", true},
        {"t_post", "time after segmentation", "ms", lower_is_better, 0.0,
         "CPU time per scan of all that follows: fits, merges, selection", true},
        {"t_total", "total time", "ms", lower_is_better, 0.0,
         "CPU time per scan before segmentation, of it and after it: t_pre + t_seg + t_post", true},
        {"polygon_bytes", "polygon size", "B", neither, 0.0, "size of a scan's polygon, 48 bytes per segment"},
        {"compression", "compression of polygons", "", neither, 0.0,
         "size of the scans' ranges, 32 bits per beam, over that of their polygons"}};
  }

  bool applies(const MetricInput& input) const override {
    return input.result.lines.size() == input.observed.frames.size();
  }

  std::vector<MetricRow> evaluate(const MetricInput& input) const override {
    SCANBENCH_ASSERT(applies(input));
    Mean segments, d_mean, d_max, d_mean_pts, d_max_scan;
    double fewest = kInf;
    double most = -fewest;
    for (std::size_t f = 0; f < input.observed.frames.size(); ++f) {
      const double count = number(input.result.lines[f].lines.size());
      segments.add(count);
      fewest = std::min(fewest, count);
      most = std::max(most, count);

      Mean group_mean, group_max, points;
      double largest = 0.0;
      for (const GroupResidual& g : group_residuals(input.observed.scan(f), input.result.lines[f])) {
        group_mean.add(ratio(g.sum, std::max(g.points, 1)));
        group_max.add(g.max);
        if (g.points > 0) points.add(g.sum / g.points, g.points);
        largest = std::max(largest, g.max);
      }
      if (group_mean.count() == 0) continue;
      d_mean.add(group_mean.value());
      d_max.add(group_max.value());
      if (points.count() == 0) continue;
      d_mean_pts.add(points.value());
      d_max_scan.add(largest);
    }

    Rows rows(describe());
    rows.add("s_min", kAll, fewest, segments.count());
    rows.add("s_mean", kAll, segments);
    rows.add("s_max", kAll, most, segments.count());
    rows.add("d_mean", kAll, d_mean);
    rows.add("d_max", kAll, d_max);
    rows.add("d_mean_pts", kAll, d_mean_pts);
    rows.add("d_max_scan", kAll, d_max_scan);
    rows.add("t_pre", kAll, time_of(input.result.times, TimePart::before));
    rows.add("t_seg", kAll, time_of(input.result.times, TimePart::segmentation));
    rows.add("t_post", kAll, time_of(input.result.times, TimePart::after));
    rows.add("t_total", kAll, time_of(input.result.times, std::nullopt));
    const double ranges_bytes = kRangeBytes * input.observed.sensor.geometry.beams();
    const double polygon_bytes = static_cast<double>(sizeof(PolygonSegment)) * segments.value();
    rows.add("polygon_bytes", kAll, polygon_bytes, segments.count());
    rows.add("compression", kAll, ratio(ranges_bytes, polygon_bytes), segments.count());
    return rows.take();
  }
};

SCANBENCH_REGISTER(MetricFamily, Siadat1997,
                   {.name = "siadat1997",
                    .summary = "segments per scan, residuals of the points, times of the stages; needs no truth",
                    .reference = "Siadat et al. 1997, tables 1-3"});

}  // namespace
}  // namespace scanbench::metrics
