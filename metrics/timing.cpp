// timing: the thread CPU time of extraction, of matching and of alignment, from the stages of a second, timed pass over
// the scans.
//
// The median over the scans is robust: a machine that is busy with other work lengthens a few of them. A reading of the
// clock ends each stage; it takes a fraction of a microsecond, which is part of the time.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/median.hpp"
#include "core/registry.hpp"
#include "metrics/rows.hpp"

namespace scanbench::metrics {
namespace {

std::vector<double> seconds_per_scan(const std::vector<StageTime>& times, std::string_view slot) {
  std::map<int, double> per_frame;
  for (const StageTime& t : times)
    if (t.frame >= 0 && t.slot == slot) per_frame[t.frame] += t.seconds;
  std::vector<double> seconds;
  seconds.reserve(per_frame.size());
  for (const auto& [frame, s] : per_frame) seconds.push_back(s);
  return seconds;
}

/// The time of an alignment, which belongs to all scans together; NaN if there was none.
double seconds_of_alignment(const std::vector<StageTime>& times) {
  double seconds = kUndefined;
  for (const StageTime& t : times)
    if (t.slot == "align") seconds = (std::isnan(seconds) ? 0.0 : seconds) + t.seconds;
  return seconds;
}

class Timing : public MetricFamily {
 public:
  using Params = NoParams;
  explicit Timing(const Params&) {}

  std::vector<MetricDescription> describe() const override {
    return {{"t_scan", "time per scan", "us", Direction::lower_is_better, 0.0, "median CPU time of extraction per scan",
             true},
            {"t_match", "time per match", "us", Direction::lower_is_better, 0.0, "median CPU time of matching per scan",
             true},
            {"t_align", "alignment time", "us", Direction::lower_is_better, 0.0,
             "CPU time of the alignment of all scans", true}};
  }

  bool applies(const MetricInput& input) const override {
    return !seconds_per_scan(input.result.times, "extract").empty();
  }

  std::vector<MetricRow> evaluate(const MetricInput& input) const override {
    const std::vector<double> seconds = seconds_per_scan(input.result.times, "extract");
    Rows rows(describe());
    rows.add("t_scan", kAll, 1e6 * median(seconds), std::ssize(seconds));
    if (const std::vector<double> matching = seconds_per_scan(input.result.times, "match"); !matching.empty())
      rows.add("t_match", kAll, 1e6 * median(matching), std::ssize(matching));
    if (const double alignment = seconds_of_alignment(input.result.times); !std::isnan(alignment))
      rows.add("t_align", kAll, 1e6 * alignment, std::ssize(input.observed.frames));
    return rows.take();
  }
};

SCANBENCH_REGISTER(MetricFamily, Timing,
                   {.name = "timing",
                    .summary = "CPU time of extraction and of matching per scan, and of an alignment; needs no truth",
                    .reference = "docs/formats.md, timing.csv"});

}  // namespace
}  // namespace scanbench::metrics
