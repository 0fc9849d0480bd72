// Readers of logs with one message per line: CARMEN and DP-SLAM.
#pragma once

#include "harness/io/exchange/log_builder.hpp"

namespace scanbench::io {

/// Throws PlacedError for a line that violates the format (log.hpp).
Recording parse_carmen(LogLines& lines, const LogOptions& options, const SensorModel& sensor);
Recording parse_dpslam(LogLines& lines, const LogOptions& options, const SensorModel& sensor);

}  // namespace scanbench::io
