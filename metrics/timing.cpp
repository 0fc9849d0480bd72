// timing: the thread CPU time of extraction, from the stages of a second, timed pass over the scans.
//
// The median over the scans is robust: a machine that is busy with other work lengthens a few of them. A reading of the
// clock ends each stage; it takes a fraction of a microsecond, which is part of the time.
#include <algorithm>
#include <map>
#include <vector>

#include "core/median.hpp"
#include "core/registry.hpp"
#include "metrics/rows.hpp"

namespace scanbench::metrics {
namespace {

std::vector<double> seconds_per_scan(const std::vector<StageTime>& times) {
  std::map<int, double> per_frame;
  for (const StageTime& t : times)
    if (t.frame >= 0 && t.of_extraction()) per_frame[t.frame] += t.seconds;
  std::vector<double> seconds;
  for (const auto& [frame, s] : per_frame) seconds.push_back(s);
  return seconds;
}

class Timing : public MetricFamily {
 public:
  using Params = NoParams;
  explicit Timing(const Params&) {}

  std::vector<MetricDescription> describe() const override {
    return {{"t_scan", "us", Direction::lower_is_better, 0.0, "median CPU time of extraction per scan", true}};
  }

  bool applies(const MetricInput& input) const override { return !seconds_per_scan(input.result.times).empty(); }

  std::vector<MetricRow> evaluate(const MetricInput& input) const override {
    const std::vector<double> seconds = seconds_per_scan(input.result.times);
    Rows rows(describe());
    rows.add("t_scan", kAll, 1e6 * median(seconds), std::ssize(seconds));
    return rows.take();
  }
};

const bool registered =
    Registry<MetricFamily>::add<Timing>({.name = "timing",
                                         .summary = "CPU time of extraction per scan; needs no truth",
                                         .reference = "docs/formats.md, timing.csv"});

}  // namespace
}  // namespace scanbench::metrics
