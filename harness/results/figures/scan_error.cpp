// Combines F1 and the number of faults into one number.
#include "harness/results/figures/scan_error.hpp"

#include <algorithm>

namespace scanbench::results {

double scan_error(double f1, double faults) {
  // F1 is a fraction of numbers of lines: two that differ, differ by more than this for scans of up to 300 lines.
  constexpr double kPerFault = 1e-8;
  constexpr double kMostFaults = 1000.0;
  return 1.0 - f1 + kPerFault * std::min(faults, kMostFaults);
}

}  // namespace scanbench::results
