// Converts the valid returns of a scan from polar to Cartesian coordinates.
#include "core/scan.hpp"

namespace scanbench {

ScanPoints valid_points(const Scan& scan) {
  ScanPoints result;
  const auto n = as_index(scan.beams());
  result.beams.resize(n);
  result.points.resize(n);
  // Every beam is written and only valid ones are counted: there is no branch per beam and no check for growth.
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const int beam = static_cast<int>(i);
    result.beams[count] = beam;
    result.points[count] = scan.point(beam);
    count += scan.valid(beam) ? 1 : 0;
  }
  result.beams.resize(count);
  result.points.resize(count);
  return result;
}

}  // namespace scanbench
