// map_growth: what a map that is made scan by scan has at the end, and what a scan costs: lines, end points and CPU
// time. The times of every scan are in timing.csv, the lines after every scan in the trace rows `map.insertion`.
//
// A line has two end points, as Lakaemper, Latecki & Wolter 2005 count them. Whether the cost of a scan grows with the
// map is judged by the medians of the halves of the run: a busy machine lengthens a few scans of either half.
#include <algorithm>
#include <map>
#include <vector>

#include "core/median.hpp"
#include "core/registry.hpp"
#include "metrics/rows.hpp"

namespace scanbench::metrics {
namespace {

/// Seconds of the `map` slot in the order of the frames.
std::vector<double> seconds_per_scan(const PipelineResult& result) {
  std::map<int, double> per_frame;
  for (const StageTime& time : result.times)
    if (time.slot == "map" && time.frame >= 0) per_frame[time.frame] += time.seconds;
  std::vector<double> seconds;
  for (const auto& [frame, s] : per_frame) seconds.push_back(s);
  return seconds;
}

class MapGrowth : public MetricFamily {
 public:
  using Params = NoParams;
  explicit MapGrowth(const Params&) {}

  std::vector<MetricDescription> describe() const override {
    using enum Direction;
    return {
        {"grown_lines", "map lines at the end", "", neither, 0.0, "lines of the map after the last scan"},
        {"grown_end_points", "map end points at the end", "", neither, 0.0, "their end points, two a line"},
        {"t_map", "mapping time per scan", "ms", lower_is_better, 0.0, "median CPU time of the mapper per scan", true},
        {"t_map_growth", "growth of mapping time", "", lower_is_better, 0.0,
         "median CPU time of the mapper per scan in the second half of the scans over that in the first half: 1 if "
         "it does not grow",
         true}};
  }

  bool applies(const MetricInput& input) const override {
    return input.result.has_map && !seconds_per_scan(input.result).empty();
  }

  std::vector<MetricRow> evaluate(const MetricInput& input) const override {
    const std::vector<double> seconds = seconds_per_scan(input.result);
    const auto middle = seconds.begin() + std::ssize(seconds) / 2;
    const auto scans = std::ssize(seconds);
    const double lines = number(input.result.map.lines.size());
    Rows rows(describe());
    rows.add("grown_lines", kAll, lines, scans);
    rows.add("grown_end_points", kAll, 2 * lines, scans);
    rows.add("t_map", kAll, 1e3 * median(seconds), scans);
    rows.add("t_map_growth", kAll,
             scans < 2 ? kUndefined : ratio(median({middle, seconds.end()}), median({seconds.begin(), middle})), scans);
    return rows.take();
  }
};

SCANBENCH_REGISTER(
    MetricFamily, MapGrowth,
    {.name = "map_growth",
     .summary = "lines, end points and CPU time per scan of a map that is made scan by scan; needs no truth",
     .reference = "Lakaemper, Latecki & Wolter 2005, section 1"});

}  // namespace
}  // namespace scanbench::metrics
