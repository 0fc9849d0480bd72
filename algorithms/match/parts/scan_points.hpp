// The returns of a scan in beam order, and the line that the surface follows at each of them.
#pragma once

#include <vector>

#include "core/scan.hpp"

namespace scanbench::matching {

/// Returns farther away than this are left out: no scanner reads them, and their squares would swamp sums.
inline constexpr double kFarthestM = 1e5;

/// The least standard deviation of a range that is assumed, also for sensors without stated noise.
inline constexpr double kLeastSigmaM = 1e-3;

/// The valid returns, sensor frame: points[k] came from beam beams[k]. The scan must outlive it.
struct ReturnedPoints {
  const Scan& scan;
  std::vector<Vec2> points;
  std::vector<int> beams;
  std::vector<double> sigmas;  ///< standard deviation of each range by the data sheet; may be 0

  std::size_t size() const { return points.size(); }
  const Vec2& direction(std::size_t k) const { return scan.sensor.geometry.direction(beams[k]); }
};
ReturnedPoints returned_points(const Scan& scan);

/// Median distance of the returns from the sensor: metres of motion per radian. 1 without returns.
double lever_of(const ReturnedPoints& scan);

/// The orthogonal least-squares line through a return and its neighbours in beam order.
struct LocalLine {
  Vec2 centre = Vec2::Zero();
  Vec2 normal = Vec2::Zero();   ///< unit, either side; zero: the neighbours are on no line
  double angle_variance = 0.0;  ///< of the normal, by the sensor's noise

  bool known() const { return normal.x() != 0.0 || normal.y() != 0.0; }
  double distance(const Vec2& p) const { return normal.dot(p - centre); }
  Vec2 project(const Vec2& p) const { return p - distance(p) * normal; }
};

/// One line per return. The window grows until the noise leaves the angle a standard deviation of 3 degrees. It is
/// around the return if its points are on a line, else before or behind it. A return whose windows all have a residual
/// larger than the noise (a corner) has no line. No window crosses more than three missing returns.
std::vector<LocalLine> local_lines(const ReturnedPoints& scan);

}  // namespace scanbench::matching
