// Reader of logs with one scan per row of numbers.
#pragma once

#include "harness/io/exchange/log_builder.hpp"

namespace scanbench::io {

/// Throws ParamError for wrong `columns`, and for a step_deg of 0 unless `beams` is 1.
void check_csv_options(const LogOptions& options);

/// Throws PlacedError for a row that does not fit the columns, ParamError for `columns` (log.hpp).
Recording parse_csv_scans(LogLines& lines, const LogOptions& options, const SensorModel& sensor);

}  // namespace scanbench::io
