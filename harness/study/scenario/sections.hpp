// Parameters of the small sections of a scenario file: limits, copies of lines, the sensor of a log.
#pragma once

#include <string>
#include <vector>

#include "core/params.hpp"
#include "core/registry.hpp"
#include "sim/line_copies.hpp"

namespace scanbench::study {

struct LimitParams {
  double seconds = 600.0;
  double memory_mib = 4096.0;
  bool sandbox = false;
  static auto fields() {
    return std::tuple{field("seconds", &LimitParams::seconds, above(0), "s", "wall time of a cell"),
                      field("memory_mib", &LimitParams::memory_mib, at_least(16), "MiB",
                            "memory of a cell; a recording that needs more is refused before it starts"),
                      field("sandbox", &LimitParams::sandbox,
                            "programs run under bubblewrap: without network, the file system read-only but for the "
                            "cell's folder; libraries without network")};
  }
};

/// A format of recorded logs (key `recording`): its options and the rules of its reader.
struct RecordingFormat {
  ModuleInfo info;
  std::vector<ParamSpec> params;
  std::vector<std::string> notes;
  std::vector<std::string> required;  ///< parameters that must be given
};
std::vector<RecordingFormat> recording_formats();

/// The fields of a sensor that a log does not state: noise and timing.
std::vector<ParamSpec> recorded_sensor_specs();

}  // namespace scanbench::study
