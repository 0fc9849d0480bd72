// Sensor presets from data sheets and papers; a scenario can override every field.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/params.hpp"
#include "core/sensor_model.hpp"

namespace scanbench::sim {

struct SensorPreset {
  std::string name;
  std::string summary;  ///< one line
  std::string source;   ///< paper or data sheet
  ParamSet params;      ///< effective: every field
};

/// By name.
const std::map<std::string, SensorPreset, std::less<>>& sensor_presets();

/// The fields of a sensor with units, bounds and docs (defaults are those of `custom`).
std::vector<ParamSpec> sensor_param_specs();

/// A sensor from a preset (or "custom") with fields overridden. Throws ConfigError for an unknown preset, ParamError
/// for a bad field. `effective`, if given, receives every field.
SensorModel make_sensor(const std::string& preset, const ParamSet& overrides, ParamSet* effective = nullptr);

}  // namespace scanbench::sim
