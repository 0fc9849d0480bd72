// timing: what extraction and matching cost, as thread CPU time, from the stages that a second pass over the scans was
// timed in.
//
// The median over the scans: a machine that is busy with something else lengthens a few of them. Each stage is closed
// by a reading of the clock, a fraction of a microsecond, which is part of the time.
#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/registry.hpp"
#include "metrics/rows.hpp"

namespace scanbench::metrics {
namespace {

/// Of one slot. Stages of `extract` have plain names; those of the other slots have the slot's and a dot in front.
std::vector<double> seconds_per_scan(const std::vector<StageTime>& times, std::string_view slot) {
  std::map<int, double> per_frame;
  for (const StageTime& t : times) {
    const std::size_t dot = t.stage.find('.');
    const std::string_view of_slot = dot == std::string::npos ? "extract" : std::string_view(t.stage).substr(0, dot);
    if (t.frame >= 0 && of_slot == slot) per_frame[t.frame] += t.seconds;
  }
  std::vector<double> seconds;
  for (const auto& [frame, s] : per_frame) seconds.push_back(s);
  return seconds;
}

double median(std::vector<double> values) {
  if (values.empty()) return kUndefined;
  std::ranges::sort(values);
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

class Timing : public MetricFamily {
 public:
  using Params = NoParams;
  explicit Timing(const Params&) {}

  std::vector<MetricDescription> describe() const override {
    return {{"t_scan", "us", Direction::lower_is_better, 0.0, "median CPU time of extraction per scan", true},
            {"t_match", "us", Direction::lower_is_better, 0.0, "median CPU time of matching per scan", true}};
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
    return rows.take();
  }
};

const bool registered =
    Registry<MetricFamily>::add<Timing>({.name = "timing",
                                         .summary = "CPU time of extraction and of matching per scan; needs no truth",
                                         .reference = "docs/formats.md, timing.csv"});

}  // namespace
}  // namespace scanbench::metrics
