// Gates: which metrics may fail a comparison of two runs, and by how much they may change. The others are watched: a
// change is shown and fails nothing.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "harness/study/scenario/gate_spec.hpp"
#include "metrics/metric.hpp"

namespace scanbench::results {

/// Descriptions of all metrics of the registered families, by name.
std::map<std::string, metrics::MetricDescription> metric_descriptions();

class Gates {
 public:
  /// Without a specification the headline metrics of a pipeline are its gates, with their families' tolerances.
  explicit Gates(const study::GateSpec& spec = {});

  /// Those of the metrics of one pipeline that are its gates: those that the specification names, else at most two
  /// headlines of what the pipeline makes (a map, poses, matches or lines).
  std::set<std::string> among(const std::set<std::string>& metrics) const;
  /// What a baseline keeps: metrics that have a better direction, and those that the specification names; of times,
  /// which depend on the machine, the latter only.
  bool is_judged(const std::string& metric) const;
  /// With the gate's tolerance. A metric of no family has no direction.
  const metrics::MetricDescription& description(const std::string& metric) const;

 private:
  std::map<std::string, metrics::MetricDescription> descriptions_;
  std::set<std::string> named_;  ///< by the specification
};

/// The metrics that are gates of some pipelines where no specification names others, those of the last stage first.
std::vector<std::string> headline_metrics();
/// True if the metric is one of them.
bool is_headline(const std::string& metric);

}  // namespace scanbench::results
