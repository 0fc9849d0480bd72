// The order of scans from worst to best that pages, `show` and the player share.
#pragma once

namespace scanbench::results {

/// Larger is worse: a scan with a lower F1, and of scans with equal F1 the one with more `faults` (false, missed and
/// split lines). NaN where F1 is: no line is true there and none was found.
double scan_error(double f1, double faults);

}  // namespace scanbench::results
