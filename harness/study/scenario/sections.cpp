// Describes the formats of logs, and selects the fields of a sensor that a log does not state.
#include "harness/study/scenario/sections.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "harness/io/exchange/log.hpp"
#include "sim/sensors.hpp"

namespace scanbench::study {

std::vector<RecordingFormat> recording_formats() {
  std::vector<RecordingFormat> formats;
  for (const auto& name : io::log_formats()) {
    const io::LogFormatText text = io::log_format_text(name);
    std::vector<std::string> notes{
        "recording: {log: FILE, format: " + name + ", ...}; FILE may be gzip and begin with ${SCANBENCH_DATA}",
        "beside these keys: relations, a file of poses of scans relative to each other, and odometry, errors that are "
        "added to the poses of the log, as in a trajectory"};
    notes.insert(notes.end(), text.notes.begin(), text.notes.end());
    formats.push_back(
        {{name, text.summary, ""}, io::log_param_specs(name), std::move(notes), io::required_log_params(name)});
  }
  return formats;
}

std::vector<ParamSpec> recorded_sensor_specs() {
  static constexpr std::array<std::string_view, 5> kOfTheLog = {"angle_min_deg", "angle_step_deg", "beams",
                                                                "range_min_m", "range_max_m"};
  std::vector<ParamSpec> specs = sim::sensor_param_specs();
  std::erase_if(specs,
                [](const ParamSpec& spec) { return std::ranges::find(kOfTheLog, spec.name) != kOfTheLog.end(); });
  return specs;
}

}  // namespace scanbench::study
