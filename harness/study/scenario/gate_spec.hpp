// The key `gates` of a suite: metrics that may fail a comparison, with the change that each may have.
//
//   gates: {f1: 0.005, offset_rms: 0.001}     # in the metric's unit; without the key: `scanbench describe metrics`
#pragma once

#include <map>
#include <string>

#include "harness/io/yaml/gate.hpp"

namespace scanbench::study {

struct GateSpec {
  std::map<std::string, double> tolerances;  ///< by metric; empty: the metric families decide
};

/// Throws PlacedError for an unknown metric, one without a better direction, and a tolerance that is not a number >= 0.
GateSpec read_gates(const io::YamlNode& node);

/// The text of gates.json.
std::string gates_json(const GateSpec& spec);

}  // namespace scanbench::study
