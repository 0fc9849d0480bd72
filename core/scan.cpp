// Polar to Cartesian, once per scan.
#include "core/scan.hpp"

namespace scanbench {

ScanPoints valid_points(const Scan& scan) {
  ScanPoints result;
  const int n = scan.beams();
  result.beams.reserve(static_cast<std::size_t>(n));
  result.points.reserve(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    if (!scan.valid(i)) continue;
    result.beams.push_back(i);
    result.points.push_back(scan.point(i));
  }
  return result;
}

}  // namespace scanbench
