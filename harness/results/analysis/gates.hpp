// Gates: which metrics may fail a comparison of two runs, and by how much they may change.
#pragma once

#include <map>
#include <string>

#include "harness/study/scenario/gate_spec.hpp"
#include "metrics/metric.hpp"

namespace scanbench::results {

/// Descriptions of all metrics of the registered families, by name.
std::map<std::string, metrics::MetricDescription> metric_descriptions();

class Gates {
 public:
  /// Without a specification every metric that has a better direction is a gate, with its family's tolerance; never a
  /// time, which depends on the machine.
  explicit Gates(const study::GateSpec& spec = {});

  bool is_gate(const std::string& metric) const;
  /// With the gate's tolerance. A metric of no family has no direction.
  const metrics::MetricDescription& description(const std::string& metric) const;

 private:
  std::map<std::string, metrics::MetricDescription> descriptions_;
  std::map<std::string, bool> is_gate_;
};

}  // namespace scanbench::results
