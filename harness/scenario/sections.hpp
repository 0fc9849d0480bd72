// Parameters of the small sections of a scenario file: limits, copies of lines, the sensor of a log.
#pragma once

#include <string>
#include <vector>

#include "core/params.hpp"
#include "core/registry.hpp"
#include "sim/line_copies.hpp"

namespace scanbench::harness {

struct LimitParams {
  double seconds = 600.0;
  double memory_mib = 4096.0;
  static auto fields() {
    return std::tuple{field("seconds", &LimitParams::seconds, above(0), "s", "wall time of a cell"),
                      field("memory_mib", &LimitParams::memory_mib, at_least(16), "MiB",
                            "memory of a cell; a recording that needs more is refused before it starts")};
  }
};

/// sim::LineCopies in the units of the file.
struct LineCopiesParams {
  std::int64_t copies = 10;
  double rotation_sigma_deg = 0.0;
  double shift_sigma_m = 0.0;
  static auto fields() {
    using P = LineCopiesParams;
    return std::tuple{field("copies", &P::copies, between(1, 10000), "", "number of copies of every wall"),
                      field("rotation_sigma_deg", &P::rotation_sigma_deg, at_least(0), "deg",
                            "standard deviation of a copy's rotation about the world's origin"),
                      field("shift_sigma_m", &P::shift_sigma_m, at_least(0), "m",
                            "standard deviation of each coordinate of a copy's shift")};
  }
  sim::LineCopies copies_of() const {
    return {.copies = static_cast<int>(copies),
            .rotation_sigma_rad = radians(rotation_sigma_deg),
            .shift_sigma_m = shift_sigma_m};
  }
};

/// A format of recorded logs (key `recording`): its options and the rules of its reader.
struct RecordingFormat {
  ModuleInfo info;
  std::vector<ParamSpec> params;
  std::vector<std::string> notes;
};
std::vector<RecordingFormat> recording_formats();

/// The fields of a sensor that a log does not state: noise and timing.
std::vector<ParamSpec> recorded_sensor_specs();

}  // namespace scanbench::harness
