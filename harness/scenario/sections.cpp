// Which fields of a sensor a log leaves open.
#include "harness/scenario/sections.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "sim/sensors.hpp"

namespace scanbench::harness {

std::vector<ParamSpec> recorded_sensor_specs() {
  static constexpr std::array<std::string_view, 5> kOfTheLog = {"angle_min_deg", "angle_step_deg", "beams",
                                                                "range_min_m", "range_max_m"};
  std::vector<ParamSpec> specs = sim::sensor_param_specs();
  std::erase_if(specs,
                [](const ParamSpec& spec) { return std::ranges::find(kOfTheLog, spec.name) != kOfTheLog.end(); });
  return specs;
}

}  // namespace scanbench::harness
